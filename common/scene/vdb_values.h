// The values of one grid of an OpenVDB file, as its tree holds them: nothing is made dense.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "common/progress.h"
#include "common/scene/vdb_layout.h"

namespace airlight {

// Active cells of one value: a cell, or a tile of the tree.
struct VdbCells {
  glm::ivec3 least, most;  // both are in it
  double value;            // of a vector its length
};

class VdbValues {
 public:
  // Whether grids of this type ("Tree_float_5_4_3") are read: floats, doubles and vectors of three floats.
  static bool reads(const std::string& type);

  // Reads the tree of a grid of the file `bytes`, which vdb_layout() has listed; the bytes need not outlive this. Throws
  // InputError "path: ..." for what is damaged, for a grid that shares another one's values and for types that are not read,
  // Interrupted.
  VdbValues(const std::string& path, std::string_view bytes, const VdbFile&, const VdbGrid&, Progress&);
  ~VdbValues();
  VdbValues(const VdbValues&) = delete;
  VdbValues& operator=(const VdbValues&) = delete;

  // Calls visit for every active value, whatever it is, in the order of the tree. Throws Interrupted.
  void each(const std::function<void(const VdbCells&)>& visit, const Progress&) const;

  std::uint64_t active() const;           // cells, those of tiles counted
  double background() const;              // of a vector its length
  const std::string& grid_class() const;  // "fog volume", "level set", ...; empty where the file does not say
  const glm::dmat4& transform() const {
    return world_;
  }  // cell (i, j, k), its centre, to the file's world [m]; may be no affine map

 private:
  class Tree;
  template <class Grid>
  class TreeOf;
  std::unique_ptr<Tree> tree_;
  glm::dmat4 world_{1.0};
  std::string grid_class_;
};

// Name and version of the library that reads them.
std::string grid_library();

}  // namespace airlight
