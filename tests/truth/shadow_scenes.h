// Scenes in which shadows are most of what there is to see. Which pixels at an edge a rasteriser of 1/256 pixel flips is chance,
// and one flipped pixel of 160 x 120 can be 1 % of a picture: these cameras are some centimetres away from where that happens.
#pragma once

#include <span>

#include "tests/truth/truth_scenes.h"

namespace airlight {

std::span<const TruthScene> shadow_scenes();

}  // namespace airlight
