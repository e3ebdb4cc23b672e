#include "common/plan/grid_gaussians.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace airlight {

namespace {

// Sums over values v at cells (x, y, z), counted from the block's first.
struct Moments {
  double mass = 0;
  glm::dvec3 first{0};
  glm::dmat3 second{0};

  // A row of a block: v, v x and v x^2 summed.
  void add_row(double v, double vx, double vxx, double y, double z) {
    mass += v;
    first += glm::dvec3(vx, v * y, v * z);
    second[0] += glm::dvec3(vxx, vx * y, vx * z);
    second[1] += glm::dvec3(0, v * y * y, v * y * z);
    second[2].z += v * z * z;
  }
};

// Mean square distance from the centre of mass [m^2], `turn` taking cells to metres: that of the cells' centres, and of the tents
// that linear interpolation makes of each value, whose variance an axis is 1/6.
double spread(const Moments& m, const glm::dvec3& mean, const glm::dmat3& turn) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    sum += glm::dot(turn[i], turn[i]) / 6;
    for (int j = i; j < 3; ++j) {
      const double covariance = m.second[i][j] / m.mass - mean[i] * mean[j];
      sum += (i == j ? 1 : 2) * covariance * glm::dot(turn[i], turn[j]);
    }
  }
  return sum;
}

}  // namespace

GridBlocks grid_blocks(const GridMedium& grid, int along) {
  const glm::ivec3& size = grid.voxels->size;
  glm::dvec3 cell, edges;
  for (int axis = 0; axis < 3; ++axis) cell[axis] = glm::length(glm::dvec3(grid.transform[axis]));
  edges = cell * glm::dvec3(size);
  const double edge = std::max({edges.x, edges.y, edges.z}) / along;
  GridBlocks blocks;
  for (int axis = 0; axis < 3; ++axis) {
    blocks.cells[axis] = static_cast<int>(std::clamp(std::ceil(edge / cell[axis] - 1e-6), 1.0, static_cast<double>(size[axis])));
    blocks.blocks[axis] = (size[axis] + blocks.cells[axis] - 1) / blocks.cells[axis];
    blocks.edge = std::max(blocks.edge, blocks.cells[axis] * cell[axis]);
  }
  return blocks;
}

std::vector<GaussianDensity> grid_gaussians(const GridMedium& grid, const GridBlocks& blocks, const glm::dvec3& origin) {
  const glm::ivec3 &size = grid.voxels->size, &side = blocks.cells, &count = blocks.blocks;
  std::vector<Moments> all(static_cast<std::size_t>(blocks.count()));
  const float* row = grid.voxels->values.data();
  for (int z = 0; z < size.z; ++z) {
    for (int y = 0; y < size.y; ++y, row += size.x) {
      Moments* block =
          &all[static_cast<std::size_t>(count.x) *
               (static_cast<std::size_t>(y / side.y) + static_cast<std::size_t>(count.y) * static_cast<std::size_t>(z / side.z))];
      for (int begin = 0; begin < size.x; begin += side.x, ++block) {
        const int cells = std::min(side.x, size.x - begin);
        double v = 0, vx = 0, vxx = 0;
        for (int x = 0; x < cells; ++x) {
          const auto value = static_cast<double>(row[begin + x]);
          v += value, vx += value * x, vxx += value * x * x;
        }
        if (v > 0) block->add_row(v, vx, vxx, y % side.y, z % side.z);
      }
    }
  }

  const glm::dmat3 turn(grid.transform);
  const double volume = std::fabs(glm::determinant(turn)) * grid.scale;
  std::vector<GaussianDensity> gaussians;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Moments& m = all[i];
    if (!(m.mass > 0)) continue;
    const int n = static_cast<int>(i), line = n / count.x;
    const glm::ivec3 block(n % count.x, line % count.y, line / count.y);
    const glm::dvec3 mean = m.first / m.mass, cell = glm::dvec3(block * side) + mean + 0.5;
    // Of exp(-r^2 / radius^2) the mean of r^2 is 3/2 radius^2, the integral (sqrt(pi) radius)^3.
    const double radius = std::sqrt(2 * spread(m, mean, turn) / 3);
    const double extinction = volume * m.mass / std::pow(radius / std::numbers::inv_sqrtpi, 3);
    GaussianDensity g{.center = glm::dvec3(grid.transform * glm::dvec4(cell, 1)) - origin,
                      .radius = static_cast<float>(radius),
                      .extinction = static_cast<float>(extinction)};
    if (g.radius > 0 && g.extinction > 0) gaussians.push_back(g);
  }
  return gaussians;
}

}  // namespace airlight
