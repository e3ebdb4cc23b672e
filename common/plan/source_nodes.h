// Where nodes of an illumination network's source function stand.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/plan/network.h"
#include "common/scene/scene.h"

namespace airlight {

// Of common/algorithms/source_function.h, places on the lattice.
struct SourceNodes {
  glm::ivec3 first{0, 0, 0};
  int stride = 1;
  glm::ivec3 nodes{2, 2, 2}, bricks{1, 1, 1};
  std::vector<std::int32_t> filled{0};
  bool too_coarse = false;  // most of the medium is in Gaussians narrower than a cell
};

// One box of cubes, `resolution` of them along the longest edge of what matters of the medium, or more where Gaussians are
// narrower than one. Where these leave most of it empty, bricks of finer cells, those alone in which any of the medium is. Of
// neither there are more nodes than in a cube of `resolution`.
SourceNodes source_nodes(const Scene&, const NetworkFrame&, int resolution);

}  // namespace airlight
