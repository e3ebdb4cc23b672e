// A voxel grid as Gaussians, for what has a closed form of these and changes slowly: optical depths over all directions.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/algorithms/medium.h"
#include "common/scene/scene.h"

namespace airlight {

// Blocks of a grid's cells, about as wide as high and deep.
struct GridBlocks {
  glm::ivec3 cells{1, 1, 1}, blocks{1, 1, 1};  // of a block and of the grid, an axis
  double edge = 0;                             // [m] of a block along its longest axis

  double count() const { return static_cast<double>(blocks.x) * blocks.y * blocks.z; }
};
// `along`: how many lie along the grid's longest edge at most, > 0; as many along any other.
GridBlocks grid_blocks(const GridMedium&, int along);

// A Gaussian for each block that is not empty, seen from `origin`: of the block's own mass, centre of mass and mean square
// distance from it, of the values as they are between the cells' centres. Their reach is 0.
std::vector<GaussianDensity> grid_gaussians(const GridMedium&, const GridBlocks&, const glm::dvec3& origin);

}  // namespace airlight
