// Voxel grids out of OpenVDB files.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <string>

#include "common/progress.h"
#include "common/scene/scene.h"

namespace airlight {

struct GridFile {
  std::shared_ptr<const VoxelGrid> voxels;
  glm::dmat4 transform{1.0};  // cells (GridMedium) to the file's world [m], affine; invertible unless the file's own is not
  std::string content_hash;   // SHA-256 of the file's bytes
};

inline constexpr std::uint64_t most_cells = std::uint64_t{1} << 29U;  // of a box: 2 GiB of floats

// The grid of that name, of float or double values (also those stored in 16 bits), in the smallest box around its active values
// other than 0; inactive ones count as 0. Throws InputError "path: ..." for what is no OpenVDB file or a damaged one; for a name
// that is not there (it lists those that are); for level sets, vectors, points and other types by their name; for a background or
// a value that is not allowed (negative, not finite, as a float), saying where; for a grid without a value above 0 and for a box
// of more than most_cells, before taking memory for it. Throws Interrupted, MachineError when memory is short.
GridFile read_grid_file(const std::string& path, const std::string& name, Progress&);

// "OpenVDB 10.0.1", as it is at run time.
std::string grid_library();

}  // namespace airlight
