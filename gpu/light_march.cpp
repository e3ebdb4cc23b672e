#include <algorithm>

#include "gpu/medium.h"

namespace airlight {

void run(const LightMarch& a, StepRunner& r, const Progress& progress) {
  std::vector<std::string> defines = bind_medium(r, a.gaussians, a.grid, a.voxels, a.light_steps, a.light_depth, a.erf);
  const int depths_at = bind_depths(r, a.voxels, {a.depths, a.depth_volumes}).depths;
  if (depths_at >= 0) defines.push_back("WITH_DEPTH_VOLUMES");
  defines.push_back(r.lights(a.lights));
  if (a.lit) defines.push_back("WITH_LIT");
  if (a.depth_toward_light) defines.push_back("WITH_DEPTH");
  Program& program = r.compute("gpu/light_march.glsl", defines);
  program.set("depth_volumes_at", depths_at);
  r.read(0, a.distance);
  if (a.lit) r.read(1, a.lit);
  r.write(0, a.light_transmittance);
  r.write(1, a.depth_toward_light);
  r.view(a.view);
  const LoopBudget budget = loop_budget(a.gaussians, a.grid, a.light_steps, a.light_depth, a.lights.size());
  const int all = static_cast<int>(a.lights.size());
  for (int first = 0; first < all; first += budget.lights) {
    program.set("first_light", first);
    program.set("end_light", std::min(first + budget.lights, all));
    r.each_pixel(program, a.light_transmittance.extent, progress);
  }
}

}  // namespace airlight
