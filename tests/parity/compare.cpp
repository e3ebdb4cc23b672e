#include "tests/parity/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace airlight {

namespace {

bool miss(float v) { return v >= 1e29F; }

}  // namespace

std::string Difference::text() const {
  char line[200];
  std::snprintf(line, sizeof line,
                "largest %.4g, beyond 1e-4 of it %.4f %% of the pixels (%.4f %% off edges), elsewhere at most %.3g", largest,
                100 * share, 100 * share_inside, worst_elsewhere);
  return finite ? line : "not finite";
}

Difference difference(const Image& image, std::span<const float> a, std::span<const float> b, const std::vector<bool>& edges) {
  Difference d;
  d.finite = a.size() == b.size() && std::all_of(a.begin(), a.end(), [](float v) { return std::isfinite(v); }) &&
             std::all_of(b.begin(), b.end(), [](float v) { return std::isfinite(v); });
  if (!d.finite) return d;
  for (const float v : a) {
    if (!miss(v)) d.largest = std::max(d.largest, std::fabs(static_cast<double>(v)));
  }
  const double scale = d.largest > 0 ? d.largest : 1;
  const auto per_pixel = static_cast<std::size_t>(channels(image.format));
  const auto pixels = static_cast<std::size_t>(image.extent.width) * static_cast<std::size_t>(image.extent.height);
  std::size_t beyond = 0, unexplained = 0;
  for (std::size_t p = 0; p < a.size() / per_pixel; ++p) {
    double worst = 0;
    for (std::size_t c = 0; c < per_pixel; ++c) {
      const float x = a[p * per_pixel + c], y = b[p * per_pixel + c];
      const double apart = miss(x) && miss(y) ? 0 : std::fabs(static_cast<double>(x) - static_cast<double>(y)) / scale;
      worst = std::max(worst, apart);
    }
    if (worst > 1e-4) {
      ++beyond;
      if (edges.empty() || !edges[p % pixels]) ++unexplained;
    } else {
      d.worst_elsewhere = std::max(d.worst_elsewhere, worst);
    }
  }
  const auto all = static_cast<double>(a.size() / per_pixel);
  d.share = static_cast<double>(beyond) / all;
  d.share_inside = static_cast<double>(unexplained) / all;
  return d;
}

std::vector<bool> edges_of(Extent extent, std::span<const float> distance) {
  const auto at = [&](int x, int y) {
    x = std::clamp(x, 0, extent.width - 1);
    y = std::clamp(y, 0, extent.height - 1);
    return static_cast<double>(
        distance[static_cast<std::size_t>(y) * static_cast<std::size_t>(extent.width) + static_cast<std::size_t>(x)]);
  };
  std::vector<bool> edges;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      bool edge = false;
      for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1), std::pair(1, -1)}) {
        // Second difference of 1/distance, which is linear along a plane.
        const double here = 1 / at(x, y), before = 1 / at(x - dx, y - dy), after = 1 / at(x + dx, y + dy);
        edge |= std::fabs(before - 2 * here + after) > 0.02 * std::max({here, before, after});
      }
      edges.push_back(edge);
    }
  }
  return edges;
}

}  // namespace airlight
