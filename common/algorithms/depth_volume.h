// Where the optical depths toward a light stand that OpticalDepthPropagation makes. The depths are a buffer; its layout and the
// lookup are told in common/formulas/depth_volume.h.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "common/half.h"

namespace airlight {

struct DepthVolume {
  // cells: the centres of a box of cubes. The others lie along the light's rays, plane behind plane of equal distance, so that a
  // ray's depths are sums along one line of nodes: parallel, of a directional light; frustum, of a point light far outside the
  // medium; cube, of one near or inside it: six faces about the light, whose planes stand closer near it, and which hold depths
  // beside the distance.
  enum class Kind : int { cells, parallel, frustum, cube };

  Kind kind = Kind::cells;
  // Row i of `rows` takes a place (x, y, z, 1) to coordinate i of the light's frame [m], in which it shines from the origin (of
  // parallel: from z = 0) along z; of cells, to cells, 0 at the first centre.
  glm::vec4 rows[3] = {};
  // A node's number is (q - first) * scale, q = (x / z, y / z, z) of frustum and cube, (x, y, z) of the others; of a cube's
  // planes cube_plane_number() of that.
  glm::vec3 first{0, 0, 0}, scale{1, 1, 1};
  glm::vec3 nodes{0, 0, 0};  // of a face, each at least 2; 0: there is no volume
  bool halves = false;  // depths are kept in 16 bits (common/half.h), 65504 at most: nothing is seen through a fraction of it

  explicit operator bool() const { return nodes.x > 0; }
  int faces() const { return kind == Kind::cube ? 6 : 1; }
  std::size_t depths() const {
    return static_cast<std::size_t>(faces()) * static_cast<std::size_t>(nodes.x) * static_cast<std::size_t>(nodes.y) *
           static_cast<std::size_t>(nodes.z);
  }
  // [float] of the buffer: head and depths.
  static constexpr std::size_t head = 9;
  std::size_t floats() const { return head + (halves ? floats_of_halves(depths()) : depths()); }
};

}  // namespace airlight
