// Where mean depths about surfaces are found.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/algorithms/medium.h"
#include "common/scene/scene.h"

namespace airlight {

// One lattice a surface, seen from `origin`.
struct SurfaceLattices {
  std::vector<DepthLattice> lattices;
  glm::dvec3 origin{0, 0, 0};
  double nodes = 0;  // in all

  // The same seen from elsewhere.
  std::vector<DepthLattice> from(const glm::dvec3& place) const;
};

// Nodes `spacing` apart [m] that hold each surface's box; its lowest corner is a node, so that a floor lies on nodes. Without
// lattices where they would have more than `most` nodes in all, `nodes` tells how many.
SurfaceLattices surface_lattices(const Scene&, double spacing, double most);
// One node in the middle of each surface's box.
SurfaceLattices surface_middles(const Scene&);

}  // namespace airlight
