// Errors of pictures beside the truth.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <string_view>

#include "common/image.h"
#include "common/reference/reference.h"

namespace airlight {

struct RelativeError {
  double off_edges = 0, everywhere = 0;  // sqrt(mean((a-b)^2)) / mean(b) over pixels and channels
};

// A picture of three channels, and which part of the truth it shows.
struct Part {
  std::string_view name;
  glm::dvec3 (*of)(const ReferencePixel&);
};
inline constexpr std::array<Part, 3> parts{{{"beauty", [](const ReferencePixel& p) { return p.beauty(); }},
                                            {"surface", [](const ReferencePixel& p) { return p.surface; }},
                                            {"airlight", [](const ReferencePixel& p) { return p.airlight; }}}};

inline RelativeError relative_error(const HostImage& image, const ReferenceFrame& truth, const Part& part) {
  struct Sum {
    double squares = 0, truth = 0, n = 0;
    double relative_rmse() const { return std::sqrt(squares / n) / (truth / n); }
  } off_edges, everywhere;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const glm::dvec3 expected = part.of(truth.pixels[i]);
    for (int c = 0; c < 3; ++c) {
      const double apart = static_cast<double>(image.values[3 * i + static_cast<std::size_t>(c)]) - expected[c];
      for (Sum* sum : {&off_edges, &everywhere}) {
        if (sum == &off_edges && truth.edges[i]) continue;
        sum->squares += apart * apart, sum->truth += expected[c], sum->n += 1;
      }
    }
  }
  return {off_edges.relative_rmse(), everywhere.relative_rmse()};
}

}  // namespace airlight
