#include "gpu/step_runner.h"

namespace airlight {

void run(const HiddenEnvironment& a, StepRunner& r, const Progress& progress) {
  Program& program = r.compute("gpu/hidden_environment.glsl", {a.specular ? "WITH_SPECULAR" : ""});
  r.read(0, a.normal);
  r.read(1, a.corners);
  r.write(0, a.diffuse);
  r.write(1, a.specular);
  r.storage(0, a.triangles);
  r.storage(tables_binding, a.table);
  r.view(a.view);
  r.each_pixel(program, a.diffuse.extent, progress);
}

}  // namespace airlight
