// A density on a grid as a sum of Gaussians.
#pragma once

#include <string>
#include <vector>

#include "common/fit/gaussian_sum.h"
#include "common/progress.h"
#include "common/scene/scene.h"
#include "common/scene/sparse_grid.h"

namespace airlight {

struct FitOptions {
  int count = 1000;  // of Gaussians, 1 to most_fitted
  int steps = 400;   // of each of the descents, at most
};
inline constexpr int most_fitted = 1'000'000;

struct Fit {
  // In the file's world; the extinction is the grid's value. Fewer than asked for where nothing is left.
  std::vector<Gaussian> gaussians;
  double density_error = 0;  // sqrt(sum (fit - grid)^2 / sum grid^2) over the cells of the grid and those around it
};

// Peaks of what is left become Gaussians, an eighth of all, then a quarter, a half, all; after each time all of them descend
// together. Then, a few times, those that matter least are put where most is left, as long as that helps. `path` stands for the
// grid in messages. The same bits for any EachIndex. Throws InputError for a transform without an inverse, Interrupted.
Fit fit_gaussians(const SparseGrid&, const std::string& path, const FitOptions&, const EachIndex&, Progress&);

}  // namespace airlight
