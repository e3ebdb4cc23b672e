// A grid's blocks as Gaussians: what they have of it.
#include "common/plan/grid_gaussians.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

#include "tests/parity/medium.h"

namespace airlight {
namespace {

struct Sums {
  double mass = 0, spread = 0;  // [m^2] about the origin
  glm::dvec3 first{0};
};

Sums of(const std::vector<GaussianDensity>& gaussians) {
  Sums s;
  for (const GaussianDensity& g : gaussians) {
    const auto radius = static_cast<double>(g.radius);
    const glm::dvec3 at(g.center);
    const double mass = static_cast<double>(g.extinction) * std::pow(radius / std::numbers::inv_sqrtpi, 3);
    s.mass += mass, s.first += mass * at;
    s.spread += mass * (glm::dot(at, at) + 1.5 * radius * radius);
  }
  return s;
}

// By plain sums over points between the cells' centres: the grid is linear there an axis at a time.
Sums of(const GridMedium& grid) {
  Sums s;
  const glm::ivec3 size = grid.voxels->size;
  const double cell = std::fabs(glm::determinant(glm::dmat3(grid.transform)));
  constexpr int parts = 4;
  const auto value = [&](const glm::ivec3& c) {
    for (int axis = 0; axis < 3; ++axis) {
      if (c[axis] < 0 || c[axis] >= size[axis]) return 0.0;
    }
    return grid.scale * static_cast<double>(grid.voxels->values[static_cast<std::size_t>(c.x + size.x * (c.y + size.y * c.z))]);
  };
  const glm::ivec3 end = parts * (size + 1);
  for (int i = 0; i < end.x * end.y * end.z; ++i) {
    const glm::ivec3 n(i % end.x, i / end.x % end.y, i / end.x / end.y), low = n / parts - 1;
    const glm::dvec3 w = (glm::dvec3(n % parts) + 0.5) / static_cast<double>(parts);
    double v = 0;
    for (int k = 0; k < 8; ++k) {
      const glm::ivec3 up(k & 1, k >> 1 & 1, k >> 2 & 1);
      v += value(low + up) * (up.x ? w.x : 1 - w.x) * (up.y ? w.y : 1 - w.y) * (up.z ? w.z : 1 - w.z);
    }
    const double mass = v * cell / (parts * parts * parts);
    const glm::dvec3 at(grid.transform * glm::dvec4(glm::dvec3(low) + w + 0.5, 1));
    s.mass += mass, s.first += mass * at, s.spread += mass * glm::dot(at, at);
  }
  return s;
}

TEST(GridGaussians, HaveTheGridsMassPlaceAndWidth) {
  const GridMedium grid = test_grid();
  const Sums truth = of(grid);
  for (const int along : {1, 3, 32}) {
    const GridBlocks blocks = grid_blocks(grid, along);
    const std::vector<GaussianDensity> gaussians = grid_gaussians(grid, blocks, {0, 0, 0});
    const Sums found = of(gaussians);
    EXPECT_LE(static_cast<double>(gaussians.size()), blocks.count());
    EXPECT_NEAR(found.mass / truth.mass, 1, 1e-5) << along;
    EXPECT_NEAR(glm::length(found.first / found.mass - truth.first / truth.mass), 0, 1e-5) << along;
    // Points amid parts of cells lack 1/12 of a part's square an axis.
    EXPECT_NEAR(found.spread / found.mass, truth.spread / truth.mass, 3e-3) << along;
  }
  EXPECT_EQ(grid_gaussians(grid, grid_blocks(grid, 1), {0, 0, 0}).size(), 1U);
}

TEST(GridGaussians, BlocksAreAboutAsWideAsHigh) {
  GridMedium grid = test_grid();  // 12 x 9 x 14 cells of 0.2 x 0.25 x 0.15 m
  const GridBlocks blocks = grid_blocks(grid, 4);
  EXPECT_EQ(blocks.cells, glm::ivec3(3, 3, 4));
  EXPECT_EQ(blocks.blocks, glm::ivec3(4, 3, 4));
  EXPECT_NEAR(blocks.edge, 0.75, 1e-9);
  EXPECT_EQ(grid_blocks(grid, 32).cells, glm::ivec3(1));
}

TEST(GridGaussians, AreNoneWhereNothingIs) {
  GridMedium grid = test_grid();
  auto empty = std::make_shared<VoxelGrid>(*grid.voxels);
  for (float& v : empty->values) v = 0;
  empty->values[0] = 2;
  grid.voxels = empty;
  EXPECT_EQ(grid_gaussians(grid, grid_blocks(grid, 16), {0, 0, 0}).size(), 1U);
  empty->values[0] = 0;
  EXPECT_TRUE(grid_gaussians(grid, grid_blocks(grid, 16), {0, 0, 0}).empty());
}

}  // namespace
}  // namespace airlight
