#include "common/scene/grid_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <new>

#include "common/error.h"

namespace airlight {

GridFile dense_grid(const SparseGrid& grid, const std::string& path, Progress& progress) {
  if (grid.size(0) * grid.size(1) * grid.size(2) > static_cast<double>(most_cells)) {
    throw InputError(fmt::format("{}: has {} x {} x {} cells, expected at most {} in all", path, grid.size(0), grid.size(1),
                                 grid.size(2), most_cells));
  }
  VoxelGrid voxels;
  voxels.size = grid.most - grid.least + 1;
  const auto nx = static_cast<std::size_t>(voxels.size.x), ny = static_cast<std::size_t>(voxels.size.y),
             nz = static_cast<std::size_t>(voxels.size.z);
  try {
    voxels.values.resize(nx * ny * nz);
  } catch (const std::bad_alloc&) {
    throw MachineError(path + ": not enough memory for its grid");
  }
  progress.report("loading the grid", 0.75);
  for (const GridBlock& block : grid.blocks) {
    progress.check();
    const glm::ivec3 at = block.first - grid.least, begin = glm::max(-at, 0), end = glm::min(voxels.size - at, 8);
    for (int z = begin.z; z < end.z; ++z) {
      for (int y = begin.y; y < end.y; ++y) {
        const float* const row = block.values.data() + 8 * (y + 8 * z);
        const auto to = static_cast<std::size_t>(at.x + begin.x) +
                        nx * (static_cast<std::size_t>(at.y + y) + ny * static_cast<std::size_t>(at.z + z));
        std::copy(row + begin.x, row + end.x, voxels.values.begin() + static_cast<std::ptrdiff_t>(to));
      }
    }
  }
  const glm::dvec3 corner = glm::dvec3(grid.least) - 0.5;
  progress.report("loading the grid", 1);
  return {std::make_shared<const VoxelGrid>(std::move(voxels)), glm::translate(grid.transform, corner), grid.content_hash};
}

GridFile read_grid_file(const std::string& path, const std::string& name, Progress& progress) {
  return dense_grid(read_sparse_grid(path, name, progress), path, progress);
}

}  // namespace airlight
