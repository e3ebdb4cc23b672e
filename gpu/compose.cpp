#include "gpu/step_runner.h"

namespace airlight {

void run(const Compose& a, StepRunner& r, const Progress& progress) {
  Program& program = r.compute("gpu/compose.glsl", {});
  r.read(0, a.surface);
  r.read(1, a.airlight);
  r.write(0, a.beauty);
  View view;
  view.extent = a.beauty.extent;
  r.view(view);
  r.each_pixel(program, a.beauty.extent, progress);
}

}  // namespace airlight
