#include "common/fit/depth_error.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <numbers>

#include "common/random.h"
#include "common/reference/grid.h"
#include "common/reference/optical_depth.h"

namespace airlight {

namespace {

glm::dvec3 on_sphere(Random& random) {
  const double z = 2 * random.next() - 1, angle = 2 * std::numbers::pi * random.next(), r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace

// A chord between two even places on a sphere is an even line through its ball.
double relative_depth_error(const std::vector<Gaussian>& gaussians, const GridMedium& grid, int rays) {
  const glm::dvec3 size(grid.voxels->size), center(grid.transform * glm::dvec4(0.5 * size, 1));
  double radius = 0;
  for (int corner = 0; corner < 8; ++corner) {
    glm::dvec3 cell;
    for (int k = 0; k < 3; ++k) cell[k] = (corner >> k & 1) != 0 ? size[k] + 0.5 : -0.5;
    radius = std::max(radius, glm::length(glm::dvec3(grid.transform * glm::dvec4(cell, 1)) - center));
  }
  const GridField field(grid);
  double off = 0, all = 0;
  for (int i = 0; i < rays; ++i) {
    Random random({0x6669740aU, 0}, static_cast<std::uint64_t>(i));
    const glm::dvec3 from = center + radius * on_sphere(random), to = center + radius * on_sphere(random);
    const double length = glm::length(to - from);
    if (!(length > 1e-6 * radius)) continue;
    const double b = field.depth(from, (to - from) / length, length), a = optical_depth(gaussians, from, to);
    off += (a - b) * (a - b), all += b * b;
  }
  return all > 0 ? std::sqrt(off / all) : 0;
}

}  // namespace airlight
