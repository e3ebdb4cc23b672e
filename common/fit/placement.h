// Where further Gaussians are put: at the peaks of what is left.
#pragma once

#include <vector>

#include "common/fit/fit_cells.h"

namespace airlight {

// Adds up to `count` Gaussians, one after the other (matching pursuit: Mallat, Zhang 1993): each stands on the cell where most is
// left, with the radius, of a fixed row of them, and the extinction that leave least. What they take is taken from `rest`, the
// grid less the Gaussians. Fewer where nothing above 0 is left.
void add_at_peaks(const FitCells&, int count, std::vector<BlockValues>& rest, std::vector<FitGaussian>&);

}  // namespace airlight
