// Voxel grids out of files as they are stored: blocks where there is something, nothing elsewhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "common/progress.h"

namespace airlight {

inline constexpr std::uint64_t most_cells = std::uint64_t{1} << 29U;  // of a box: 2 GiB of floats

// Eight cells an axis. Value (x, y, z) of it stands at x + 8 (y + 8 z).
struct GridBlock {
  glm::ivec3 first{0};  // its first cell, a multiple of 8 each
  std::array<float, 512> values{};
};

struct SparseGrid {
  std::vector<GridBlock> blocks;  // that have a value above 0, by z, then y, then x
  glm::ivec3 least{0}, most{0};   // the box of the values above 0, both in it
  glm::dmat4 transform{1.0};      // cell (i, j, k), its centre, to the file's world [m], affine
  std::string content_hash;       // SHA-256 of the file's bytes

  // How many cells the box has along an axis.
  double size(int axis) const { return static_cast<double>(most[axis]) - static_cast<double>(least[axis]) + 1; }
};

// The grid of that name of an OpenVDB file, of float or double values (also those stored in 16 bits), or that of an NRRD file
// (common/scene/nrrd_file.h), which has one grid and no name. Inactive values count as 0. Throws InputError "path: ..." for what
// is neither or damaged; for a name that is not there (it lists those that are); for level sets, vectors, points and other types
// by their name; for a background or a value that is not allowed (negative, not finite, as a float), saying where; for a grid
// without a value above 0; beyond 2^21 blocks. Throws Interrupted, MachineError when memory is short.
SparseGrid read_sparse_grid(const std::string& path, const std::string& name, Progress&);

// Makes blocks of values given in any order.
class SparseGridBuilder {
 public:
  explicit SparseGridBuilder(const std::string& path);
  ~SparseGridBuilder();
  SparseGridBuilder(const SparseGridBuilder&) = delete;
  SparseGridBuilder& operator=(const SparseGridBuilder&) = delete;

  // One value for all cells of a box, least and most both in it. Above 0 and finite, as others need no block.
  void set(const glm::ivec3& least, const glm::ivec3& most, float value);
  // False: nothing was set.
  bool finish(SparseGrid&);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace airlight
