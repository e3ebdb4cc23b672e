// From triangles in space to triangles on the pixel grid, sorted by tile.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/algorithms/surface_visibility.h"
#include "cpu/parallel.h"
#include "cpu/tile.h"

namespace airlight {

// A projected triangle. Pixel (i, j) is covered where q[k] + a[k] i + b[k] j >= 0 for its three edges: exact, since vertices are
// rounded to 1/256 pixel; the top-left rule is in q. 1/z there is k0 + kx i + ky j, held in kmin..kmax.
struct PixelTriangle {
  std::int32_t x0, y0, x1, y1;  // pixels whose centre lies in the bounding box, inclusive, inside the image
  std::int32_t a[3], b[3];      // below 2^25 in magnitude
  std::int64_t q[3];
  double k0, kx, ky;
  float kmin, kmax;
  std::uint32_t id;  // of the triangle in space
};

// Triangles of a contiguous range, and for each tile which of them touch its pixels by their bounding box.
struct TriangleChunk {
  std::vector<PixelTriangle> triangles;
  std::vector<std::uint32_t> tiles;    // ascending, each once
  std::vector<std::uint32_t> begin;    // of each tile's part of `members`; one more at the end
  std::vector<std::uint32_t> members;  // positions in `triangles`, ascending within a tile
  std::vector<std::uint32_t> count;    // scratch
  std::size_t dropped = 0;             // of the triangles in space: no part of them is among `triangles`

  std::span<const std::uint32_t> of_tile(std::uint32_t tile) const;
};

class TriangleSetup {
 public:
  // Of the triangles those that touch the tiles of these rows.
  void run(const SurfaceVisibility&, Rows, std::span<const float> positions, std::span<const std::uint32_t> triangles, Workers&);
  // In order of the triangles, however many threads there were.
  std::span<const TriangleChunk> chunks() const { return {chunks_.data(), used_}; }

 private:
  // In the camera's frame: right, up, forward [m], and on the screen [1/256 pixel].
  struct Vertex {
    double x, y, z;
    double nearness = 0;  // 1/z
    std::int32_t sx = 0, sy = 0;
    bool inside = false;  // in front of the near plane and within the guard band
  };
  class Projection;

  void add(const Projection&, TriangleChunk&, const Vertex&, const Vertex&, const Vertex&, std::uint32_t id) const;
  void clip(const Projection&, TriangleChunk&, const Vertex&, const Vertex&, const Vertex&, std::uint32_t id) const;
  void sort_by_tile(TriangleChunk&, const Tiling&) const;

  std::vector<Vertex> vertices_;
  std::vector<TriangleChunk> chunks_;
  std::size_t used_ = 0;
};

}  // namespace airlight
