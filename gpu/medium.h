// Gaussians and grid for the shaders that include gpu/medium.glsl.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/algorithms/medium.h"
#include "gpu/step_runner.h"

namespace airlight {

// Binds them, and returns the defines under which the shader finds them.
std::vector<std::string> bind_medium(StepRunner&, const std::vector<GaussianDensity>&, const GridDensity&, const Buffer& voxels,
                                     int light_steps, LightDepth);

// Mesa's llvmpipe leaves all loops of a shader once it has gone round 65535 times, without a word: what a dispatch may ask of an
// invocation.
struct LoopBudget {
  static constexpr std::int64_t most = 50000;
  std::int64_t a_light;  // rounds for one place and one light
  int lights;            // how many lights fit, at least 1
};
// Of `most` rounds. Throws MachineError where one light alone does not fit.
LoopBudget loop_budget(const std::vector<GaussianDensity>&, const GridDensity&, int light_steps, LightDepth, std::size_t lights,
                       std::int64_t most = LoopBudget::most);

}  // namespace airlight
