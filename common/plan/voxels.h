// A voxel grid as the algorithms read it.
#pragma once

#include <cstddef>
#include <vector>

#include "common/algorithms/medium.h"
#include "common/algorithms/voxel_table.h"
#include "common/plan/plan.h"
#include "common/scene/scene.h"

namespace airlight {

// In 1/m, as common/algorithms/voxel_table.h lays them out.
std::vector<float> voxel_table(const GridMedium&);

// Where the grid stands, seen from the camera.
GridDensity grid_density(const GridMedium&, const glm::dvec3& camera);

Plan::Upload voxels_of(const GridMedium&, std::uint32_t id);

}  // namespace airlight
