#include "gpu/step_runner.h"

namespace airlight {

void run(const FillAirlight& a, StepRunner& r, const Progress& progress) {
  Program& program = r.compute("gpu/fill_airlight.glsl", {a.per_light ? "WITH_PER_LIGHT" : ""});
  r.read(0, a.remaining);
  r.read(1, a.upsampled);
  r.read(2, a.upsampled_transmittance);
  r.read(3, a.computed);
  r.read(4, a.computed_transmittance);
  if (a.per_light) {
    r.read(5, a.upsampled_per_light);
    r.read(6, a.computed_per_light);
    program.set("layers", a.per_light.layers);
  }
  r.write(0, a.airlight);
  r.write(1, a.per_light);
  r.write(2, a.transmittance);
  View view;
  view.extent = a.airlight.extent;
  r.view(view);
  r.each_pixel(program, a.airlight.extent, progress);
}

}  // namespace airlight
