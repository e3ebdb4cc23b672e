// Shadow planes on the screen: what a pixel evaluates to know whether its ray crosses one, and where. Both backends use this.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/algorithms/shadow_planes.h"
#include "common/rows.h"

namespace airlight {

// c[0] + c[1] i + c[2] j over pixel columns and rows.
struct ScreenFunction {
  double c[3];
};

// A shadow plane of light L and edge AB. Seen from the camera its border are the lines LA, LB and AB, straight lines of the
// image; 1/z along the camera's axis is linear over the image, too. So four linear functions tell everything, wherever the plane
// lies: behind the camera, through it, seen edge-on, out to infinity. Nothing is clipped or divided.
//
// The ray of a pixel crosses the plane where u >= 0, v < 0, e >= 0, and k > 1 / z of the ray's end. u and v are the lines LA and
// LB, computed from one vertex alone: planes that share it share the line, bit for bit, and a ray crosses one of them or the
// other.
struct ShadowQuad {
  ScreenFunction u, v, e, k;
  std::int32_t change;  // of the number of triangles between ray and light
};

// The view's rays in double.
class ScreenRays {
 public:
  explicit ScreenRays(const View&);
  // dot(x right + y up + forward, w) as a function of the pixel.
  ScreenFunction along(const double (&w)[3]) const;
  // Positive multiple of f that is 1 at most somewhere over the image.
  ScreenFunction scaled(ScreenFunction f) const;
  Extent extent() const { return extent_; }

 private:
  double right_[3], up_[3], forward_[3];
  double left_, top_, step_;
  Extent extent_;
};

// Shadow planes of a contiguous range of edges, and for each tile (square, `side` pixels, row by row) which of them may touch its
// pixels: `members` from begin[t] to begin[t + 1], ascending.
struct ShadowQuads {
  std::vector<ShadowQuad> quads;
  std::vector<std::uint32_t> begin, members;

  // Planes that touch no pixel are left out. Tiles are numbered from the first row of tiles that has some of `rows`, to the last.
  void make(const ScreenRays&, const ShadowLight&, std::span<const ShadowEdge>, int side, Rows rows = {});
  std::span<const std::uint32_t> of_tile(std::size_t tile) const {
    return std::span(members).subspan(begin[tile], begin[tile + 1] - begin[tile]);
  }
};

// The parts of the buffer.
struct ShadowVolumesView {
  std::span<const ShadowLight> lights;
  std::span<const ShadowEdge> edges;
  ShadowVolumesView(std::span<const std::byte>, std::size_t lights);
  std::span<const ShadowEdge> of(const ShadowLight& light) const {
    return edges.subspan(static_cast<std::size_t>(light.first), static_cast<std::size_t>(light.count));
  }
};

// How many tiles of `side` pixels the image has, and how many of them no plane of any light touches: what a light reaches is one
// answer for all of such a tile.
struct TileCount {
  std::size_t all = 0, without_planes = 0;
};
TileCount count_tiles(const View&, const ShadowVolumesView&, int side);

}  // namespace airlight
