// Scenes of Gaussians, among them those in which the published approximation fails (Zhou et al. 2007, figure 7).
#pragma once

#include <span>

#include "tests/truth/truth_scenes.h"

namespace airlight {

std::span<const TruthScene> gaussian_scenes();

}  // namespace airlight
