// Errors of pictures beside the truth.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <string_view>

#include "common/image.h"
#include "common/reference/reference.h"
#include "common/relative_rmse.h"

namespace airlight {

struct RelativeError {
  double off_edges = 0, everywhere = 0;
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
  RelativeRmse off_edges, everywhere;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const glm::dvec3 expected = part.of(truth.pixels[i]);
    for (int c = 0; c < 3; ++c) {
      const auto value = static_cast<double>(image.values[3 * i + static_cast<std::size_t>(c)]);
      everywhere.add(value, expected[c]);
      if (!truth.edges[i]) off_edges.add(value, expected[c]);
    }
  }
  return {off_edges.value(), everywhere.value()};
}

}  // namespace airlight
