#include "gpu/step_runner.h"

namespace airlight {

void run(const Subsample& a, StepRunner& r, const Progress& progress) {
  Program& program = r.compute("gpu/subsample.glsl", {});
  r.read(0, a.whole);
  r.write(0, a.part);
  program.set("stride", a.stride);
  program.set("whole_row", r.held_rows(a.part.extent).first * a.stride - r.held_rows(a.whole.extent).first);
  View view;
  view.extent = a.part.extent;
  r.view(view);
  r.each_pixel(program, a.part.extent, progress);
}

}  // namespace airlight
