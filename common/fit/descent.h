// Gaussians moved, widened and thickened until they leave least of a grid.
#pragma once

#include <functional>
#include <vector>

#include "common/fit/gaussian_sum.h"

namespace airlight {

// Steps of a quasi-Newton method with limited memory (L-BFGS: Liu, Nocedal 1989), up to `steps` of them, fewer where the last ten
// left hardly less. Extinctions stay above 0 for they are squares, radii above a fixed share of a cell; each variable is scaled
// by what a Gaussian's own square contributes to the second derivative, so that thin and thick ones move alike, and none farther
// in a step than the model of it holds. after(half_squares) is called after each step. Returns half the sum of the squares of
// what is left. The same bits on every machine and for any EachIndex.
double descend(const FitCells&, GaussianSum&, int steps, std::vector<FitGaussian>&, const std::function<void(double)>& after);

}  // namespace airlight
