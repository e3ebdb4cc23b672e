// A voxel grid as the algorithms read it.
#pragma once

#include <cstddef>
#include <vector>

#include "common/algorithms/medium.h"
#include "common/scene/scene.h"
#include "common/techniques/technique.h"

namespace airlight {

// The table of grid_extinction() in common/formulas/grid.h, in 1/m, and behind it, from bricks_at() on, that of grid_bound().
std::vector<float> voxel_table(const GridMedium&);
std::size_t bricks_at(const GridDensity&);
int bricks_an_axis(int cells);
// [float] of the whole table.
std::size_t voxel_table_floats(const glm::ivec3& cells);

// Where the grid stands, seen from the camera.
GridDensity grid_density(const GridMedium&, const glm::dvec3& camera);

Plan::Upload voxels_of(const GridMedium&, std::uint32_t id);

}  // namespace airlight
