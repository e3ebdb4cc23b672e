// How far two results of the same case are apart.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/image.h"

namespace airlight {

struct Difference {
  bool finite = true;          // both sides, everywhere
  double largest = 0;          // of |a| over the image, misses (1e30) left out: the scale of what follows
  double share = 0;            // of the pixels that differ by more than 1e-4 of it
  double share_inside = 0;     // of those, the pixels whose neighbours see the same surface: no edge explains them
  double worst_elsewhere = 0;  // largest difference of the other pixels, as a fraction of `largest`
  std::string text() const;
};

// `edges`: where a pixel lies at an edge; empty: nowhere.
Difference difference(const Image&, std::span<const float> a, std::span<const float> b, const std::vector<bool>& edges);

// Pixels with a neighbour (of 8) whose distance or material jumps: more than 2 % and more than the slope of the surface explains.
std::vector<bool> edges_of(Extent, std::span<const float> distance);

}  // namespace airlight
