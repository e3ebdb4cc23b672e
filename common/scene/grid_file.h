// Voxel grids out of files, made dense for rendering.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <string>

#include "common/progress.h"
#include "common/scene/scene.h"
#include "common/scene/sparse_grid.h"

namespace airlight {

struct GridFile {
  std::shared_ptr<const VoxelGrid> voxels;
  glm::dmat4 transform{1.0};  // cells (GridMedium) to the file's world [m], affine; invertible unless the file's own is not
  std::string content_hash;   // SHA-256 of the file's bytes
};

// What read_sparse_grid() reads, in the smallest box around its values above 0. Throws what that throws, and InputError for a box
// of more than most_cells, before taking memory for it.
GridFile read_grid_file(const std::string& path, const std::string& name, Progress&);

// `path` stands for the grid in messages.
GridFile dense_grid(const SparseGrid&, const std::string& path, Progress&);

}  // namespace airlight
