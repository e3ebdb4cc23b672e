// Which Gaussians the rays of small squares of the screen may meet, for all squares at once: O(n + k), k pairs of a Gaussian and
// a square. Only + - * / and square roots: the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "common/algorithms/medium.h"
#include "common/algorithms/view.h"
#include "common/plan/gaussian_panels.h"

namespace airlight {

// Squares of bin_side pixels, row by row.
inline int bin_columns(Extent e) { return (e.width + bin_side - 1) / bin_side; }
inline int bin_rows(Extent e) { return (e.height + bin_side - 1) / bin_side; }

// Whether some square does.
bool in_view(const View&, const GaussianDensity&);

// Where the list of each square begins among these numbers, and where the last ends; then the lists, each ascending: Gaussians
// the box of whose reach on the screen touches the square. Throws InputError where lists would be longer than 2^28 in all, whose
// message names the setting and what is listed.
std::vector<std::int32_t> gaussian_bins(const View&, std::span<const GaussianDensity>, std::string_view setting = "light_path",
                                        std::string_view what = "Gaussians");
// How many numbers these are.
std::size_t count_gaussian_bins(const View&, std::span<const GaussianDensity>);

}  // namespace airlight
