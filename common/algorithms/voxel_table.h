// Where the extinctions of a voxel grid stand in their buffer: the table of grid_extinction() in common/formulas/grid.h, and
// behind it, from bricks_at() on, that of grid_bound().
#pragma once

#include <cstddef>

#include "common/algorithms/medium.h"
#include "common/half.h"

namespace airlight {

constexpr int brick_side = 4;  // lookups, as in grid_bound()

// Lookups begin at every cell of a grid in its ring of zeros but the last.
constexpr int bricks_an_axis(int cells) { return (cells + 1 + brick_side - 1) / brick_side; }

// Values of the grid and its ring of zeros, behind the three numbers of cells.
inline std::size_t voxel_values(const glm::ivec3& cells) {
  return static_cast<std::size_t>(cells.x + 2) * static_cast<std::size_t>(cells.y + 2) * static_cast<std::size_t>(cells.z + 2);
}
// [float] before the bricks, and of all. halves: GridDensity::half_unit is not 0.
inline std::size_t bricks_at(const glm::ivec3& cells, bool halves = false) {
  return 3 + (halves ? floats_of_halves(voxel_values(cells)) : voxel_values(cells));
}
inline std::size_t bricks_at(const GridDensity& grid) { return bricks_at(glm::ivec3(grid.size), grid.half_unit > 0); }
inline std::size_t voxel_table_floats(const glm::ivec3& cells, bool halves = false) {
  const auto bricks = [](int n) { return static_cast<std::size_t>(bricks_an_axis(n)); };
  return bricks_at(cells, halves) + 3 + bricks(cells.x) * bricks(cells.y) * bricks(cells.z);
}

}  // namespace airlight
