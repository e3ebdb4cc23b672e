#include "common/algorithms/environment_light.h"
#include "gpu/step_runner.h"

namespace airlight {

void run(const HiddenEnvironment& a, StepRunner& r, const Progress& progress) {
  Program& program =
      r.compute("gpu/hidden_environment.glsl", {a.specular ? "WITH_SPECULAR" : "", a.brdfs > 0 ? "WITH_BRDFS" : ""});
  constexpr auto brdf_floats = static_cast<int>(brdf_lobe_floats);
  program.set("first_vertex", hidden_head_floats + brdf_floats * a.brdfs);
  if (a.brdfs > 0 && a.specular) program.set("brdf_floats", brdf_floats);
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
