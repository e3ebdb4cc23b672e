#include "gpu/step_runner.h"

namespace airlight {

void run(const ViewTransmittance& a, StepRunner& r, const Progress& progress) {
  Program& program = r.compute("gpu/view_transmittance.glsl", {a.optical_depth ? "WITH_OPTICAL_DEPTH" : ""});
  r.read(0, a.distance);
  r.write(0, a.transmittance);
  r.write(1, a.optical_depth);
  View view;
  view.extent = a.transmittance.extent;
  r.view(view);
  struct {
    float extinction, sky_distance, unused[2];
  } const knobs{a.extinction, a.sky_distance, {}};
  r.block(knobs_binding, knobs);
  r.each_pixel(program, a.transmittance.extent, progress);
}

}  // namespace airlight
