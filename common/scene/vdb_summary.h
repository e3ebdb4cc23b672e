// What is in an OpenVDB file, grid by grid.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "common/progress.h"

namespace airlight {

struct VdbSummary {
  std::string name, type;  // "density", "float"
  bool half = false;       // stored in 16 bits
  std::string unread;      // why its values are not told; empty: they are, below
  std::string grid_class;  // "fog volume", ...; may be empty
  std::uint64_t active = 0;
  glm::ivec3 least{0}, most{0};    // box of the active cells, both in it; empty without any
  double lowest = 0, highest = 0;  // of the active values, of vectors their lengths
  glm::dmat4 transform{1.0};       // cell (i, j, k), its centre, to the world [m]
};

// Nothing is made dense. Throws InputError for a file that is no OpenVDB file or whose list of grids is damaged; of a grid that
// is, what() is its `unread`. Throws Interrupted.
std::vector<VdbSummary> summarise_vdb(const std::string& path, Progress&);

}  // namespace airlight
