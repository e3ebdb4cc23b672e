// How far the optical depths of Gaussians are from those of the grid that they stand for.
#pragma once

#include <vector>

#include "common/scene/scene.h"

namespace airlight {

// sqrt(sum (a - b)^2 / sum b^2) over `rays` lines, a the optical depth through the Gaussians, b through the grid, exact but for
// rounding. Lines are drawn evenly over all that meet the ball around the grid's box, the same each time, those that miss the
// grid among them.
double relative_depth_error(const std::vector<Gaussian>&, const GridMedium&, int rays);

}  // namespace airlight
