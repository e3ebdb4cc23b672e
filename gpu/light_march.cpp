#include <algorithm>

#include "gpu/medium.h"

namespace airlight {

void run(const LightMarch& a, StepRunner& r, const Progress& progress) {
  std::vector<std::string> defines = bind_medium(r, a.gaussians, a.grid, a.voxels, a.light_steps, a.light_depth, a.erf);
  DepthTables depths(r, a.voxels, a.depths, a.depth_volumes, defines);
  defines.push_back(r.lights(a.lights));
  if (a.lit) defines.push_back("WITH_LIT");
  if (a.depth_toward_light) defines.push_back("WITH_DEPTH");
  Program& program = r.compute("gpu/light_march.glsl", defines);
  r.read(0, a.distance);
  if (a.lit) r.read(1, a.lit);
  r.write(0, a.light_transmittance);
  r.write(1, a.depth_toward_light);
  r.view(a.view);
  const LoopBudget budget = loop_budget(a.gaussians, a.grid, a.light_steps, a.light_depth, a.lights.size());
  for (int first = 0, end = 0; first < static_cast<int>(a.lights.size()); first = end) {
    end = std::min(first + budget.lights, depths.hold(program, first, a.lights.size()));
    program.set("first_light", first);
    program.set("end_light", end);
    r.each_pixel(program, a.light_transmittance.extent, progress);
  }
}

}  // namespace airlight
