// What gpu/gaussian_mean_depth.glsl takes.
#pragma once

#include <vector>

#include "common/algorithms/medium.h"
#include "gpu/step_runner.h"

namespace airlight {

// Throws MachineError where they are more than a shader's loops may be (LoopBudget).
void bind_mean_depth(StepRunner&, const std::vector<GaussianDensity>&);

}  // namespace airlight
