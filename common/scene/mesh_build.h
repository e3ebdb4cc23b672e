// From the vertices and triangles of a file to a Mesh: joined vertices, unit normals.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/scene/scene.h"

namespace airlight {

struct RawMesh {
  std::vector<glm::vec3> positions;   // finite
  std::vector<glm::vec3> normals;     // empty, or one a vertex
  std::vector<glm::uvec3> triangles;  // indices below positions.size()
};

// Joins vertices that are equal in every bit (position, and normal where there is one), drops triangles of zero area
// and vertices that none uses. Order is that of first use.
void join_vertices(RawMesh&);

// Unit normals: `flat` gives every triangle its own vertices and the normal of its plane; else the given ones where all
// are usable; else smooth ones, over edges whose faces turn by less than 60 degrees (vertices are split at sharper
// ones). Only + - * / sqrt, so the bits do not depend on the machine. The mesh comes from join_vertices().
Mesh with_normals(RawMesh&&, bool flat);

}  // namespace airlight
