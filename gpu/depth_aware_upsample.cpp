#include "gpu/step_runner.h"

namespace airlight {

void run(const DepthAwareUpsample& a, StepRunner& r, const Progress& progress) {
  Program& program = r.compute("gpu/depth_aware_upsample.glsl", {a.per_light ? "WITH_PER_LIGHT" : ""});
  r.read(0, a.distance);
  r.read(1, a.sampled_distance);
  r.read(2, a.sampled_airlight);
  r.read(3, a.sampled_transmittance);
  if (a.per_light) r.read(4, a.sampled_per_light);
  r.write(0, a.airlight);
  r.write(1, a.per_light);
  r.write(2, a.remaining);
  r.write(3, a.transmittance);
  View view;
  view.extent = a.airlight.extent;
  r.view(view);
  struct {
    int columns, rows, layers, sampled_row;
    float step, tolerance, unused[2];
  } const knobs{a.sampled_distance.extent.width,
                a.sampled_distance.extent.height,
                a.per_light.layers,
                r.held_rows(a.sampled_distance.extent).first,
                1 / static_cast<float>(a.stride),
                a.tolerance,
                {}};
  r.block(knobs_binding, knobs);
  r.each_pixel(program, a.airlight.extent, progress);
}

}  // namespace airlight
