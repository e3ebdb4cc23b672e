#include "cpu/surface_visibility_setup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>

namespace airlight {

namespace {

constexpr int subpixel = 256;
constexpr double guard = 65536;  // [pixel] on every side: coordinates stay below 2^24 + 2^24 sub-pixels
constexpr std::size_t chunk_size = 2048;
constexpr int block = 4096;  // vertices

}  // namespace

// Scalar double code: the same on every SIMD target.
class TriangleSetup::Projection {
 public:
  Projection(const SurfaceVisibility& a, const Tiling& tiling)
      : first_row(tiling.first_row() * tile_side),
        last_row(std::min(first_row + tiling.rows() * tile_side, a.view.extent.height) - 1),
        view_(a.view) {
    const double w = view_.extent.width, h = view_.extent.height, tan = view_.tan_half_fov;
    scale_ = h / (2 * tan);
    step = 2 * tan / h;
    left = ((0.5 + static_cast<double>(view_.offset.x)) * 2 / w - 1) * tan * w / h;
    top = (1 - (0.5 + static_cast<double>(view_.offset.y)) * 2 / h) * tan;
  }

  Vertex camera_frame(const float* p) const {
    const auto along = [&](const glm::vec3& axis) {
      return static_cast<double>(axis.x) * static_cast<double>(p[0]) + static_cast<double>(axis.y) * static_cast<double>(p[1]) +
             static_cast<double>(axis.z) * static_cast<double>(p[2]);
    };
    return project({along(view_.right), along(view_.up), along(view_.forward)});
  }

  Vertex project(Vertex v) const {
    v.inside = v.z >= near();
    if (!v.inside) return v;
    v.nearness = 1 / v.z;
    const double px = v.x * v.nearness * scale_ + view_.extent.width * 0.5 - static_cast<double>(view_.offset.x);
    const double py = -v.y * v.nearness * scale_ + view_.extent.height * 0.5 - static_cast<double>(view_.offset.y);
    v.inside = std::fabs(px) <= guard && std::fabs(py) <= guard;
    if (!v.inside) return v;
    v.sx = static_cast<std::int32_t>(std::nearbyint(px * subpixel));
    v.sy = static_cast<std::int32_t>(std::nearbyint(py * subpixel));
    return v;
  }

  double near() const { return view_.near_plane; }
  // |x| <= z * reach and |y| <= z * reach keep a point inside the guard band, whatever the image's extent.
  double reach() const { return (guard - std::max(view_.extent.width, view_.extent.height) * 0.5 - 1) / scale_; }
  Extent extent() const { return view_.extent; }

  double step;                    // of the image plane a pixel
  double left, top;               // image plane position of pixel (0, 0)
  const int first_row, last_row;  // that are made

 private:
  const View& view_;
  double scale_;  // [pixel] per unit of the image plane
};

void TriangleSetup::add(const Projection& projection, TriangleChunk& chunk, const Vertex& v0, const Vertex& v1, const Vertex& v2,
                        std::uint32_t id) const {
  const auto low = [](std::int32_t a, std::int32_t b, std::int32_t c) { return std::min(a, std::min(b, c)); };
  const auto high = [](std::int32_t a, std::int32_t b, std::int32_t c) { return std::max(a, std::max(b, c)); };
  const Extent extent = projection.extent();
  PixelTriangle t;
  // The first centre at or after the least coordinate, the last at or before the greatest.
  t.x0 = std::max(0, (low(v0.sx, v1.sx, v2.sx) + subpixel / 2 - 1) >> 8);
  t.y0 = std::max(projection.first_row, (low(v0.sy, v1.sy, v2.sy) + subpixel / 2 - 1) >> 8);
  t.x1 = std::min(extent.width - 1, (high(v0.sx, v1.sx, v2.sx) - subpixel / 2) >> 8);
  t.y1 = std::min(projection.last_row, (high(v0.sy, v1.sy, v2.sy) - subpixel / 2) >> 8);
  if (t.x0 > t.x1 || t.y0 > t.y1) return;

  const auto area =
      static_cast<std::int64_t>(v1.sx - v0.sx) * (v2.sy - v0.sy) - static_cast<std::int64_t>(v1.sy - v0.sy) * (v2.sx - v0.sx);
  if (area == 0) return;
  const std::array<const Vertex*, 3> corner{&v0, area > 0 ? &v1 : &v2, area > 0 ? &v2 : &v1};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vertex &from = *corner[k], &to = *corner[(k + 1) % 3];
    const std::int32_t dx = to.sx - from.sx, dy = to.sy - from.sy;
    t.a[k] = -dy;
    t.b[k] = dx;
    const bool top_left = dy < 0 || (dy == 0 && dx > 0);
    const std::int64_t at_first =
        static_cast<std::int64_t>(dx) * (subpixel / 2 - from.sy) - static_cast<std::int64_t>(dy) * (subpixel / 2 - from.sx);
    // at_first + 256 (a i + b j) >= (top_left ? 0 : 1), divided by 256 and rounded down.
    t.q[k] = (at_first - (top_left ? 0 : 1)) >> 8;
  }

  // 1/z = n.(x, y, 1) / n.v on the image plane, n the normal of the exact triangle.
  const double ux = v1.x - v0.x, uy = v1.y - v0.y, uz = v1.z - v0.z;
  const double wx = v2.x - v0.x, wy = v2.y - v0.y, wz = v2.z - v0.z;
  const double nx = uy * wz - uz * wy, ny = uz * wx - ux * wz, nz = ux * wy - uy * wx;
  const double plane = nx * v0.x + ny * v0.y + nz * v0.z;
  t.kmin = static_cast<float>(std::min(v0.nearness, std::min(v1.nearness, v2.nearness)));
  t.kmax = static_cast<float>(std::max(v0.nearness, std::max(v1.nearness, v2.nearness)));
  const double inverse = 1 / plane;
  t.kx = nx * projection.step * inverse;
  t.ky = -ny * projection.step * inverse;
  t.k0 = (nx * projection.left + ny * projection.top + nz) * inverse;
  if (!(std::fabs(t.k0) + std::fabs(t.kx) + std::fabs(t.ky) < 1e30)) {  // seen edge-on
    t.k0 = static_cast<double>(t.kmin);
    t.kx = t.ky = 0;
  }
  t.id = id;
  chunk.triangles.push_back(t);
}

void TriangleSetup::clip(const Projection& projection, TriangleChunk& chunk, const Vertex& v0, const Vertex& v1, const Vertex& v2,
                         std::uint32_t id) const {
  const double reach = projection.reach();
  const auto outside = [&](const Vertex& v, int plane) {  // distance to each of five planes; negative: cut away
    switch (plane) {
      case 0:
        return v.z - projection.near();
      case 1:
        return v.z * reach - v.x;
      case 2:
        return v.z * reach + v.x;
      case 3:
        return v.z * reach - v.y;
      default:
        return v.z * reach + v.y;
    }
  };
  std::array<Vertex, 8> polygon{v0, v1, v2}, next;
  std::size_t n = 3;
  for (int plane = 0; plane < 5 && n >= 3; ++plane) {
    std::size_t m = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vertex &from = polygon[i], &to = polygon[(i + 1) % n];
      const double d0 = outside(from, plane), d1 = outside(to, plane);
      if (d0 >= 0) next[m++] = from;
      if ((d0 >= 0) == (d1 >= 0)) continue;
      // Cut in an order that both triangles of an edge share, so that they cut it at the same point.
      const bool turn = std::tie(to.x, to.y, to.z) < std::tie(from.x, from.y, from.z);
      const Vertex &a = turn ? to : from, &b = turn ? from : to;
      const double da = turn ? d1 : d0, db = turn ? d0 : d1, s = da / (da - db);
      next[m++] = {a.x + (b.x - a.x) * s, a.y + (b.y - a.y) * s, a.z + (b.z - a.z) * s};
    }
    polygon = next;
    n = m;
  }
  if (n < 3) return;
  for (std::size_t i = 0; i < n; ++i) {
    polygon[i].z = std::max(polygon[i].z, projection.near());
    polygon[i] = projection.project(polygon[i]);
    if (!polygon[i].inside) return;  // cannot be: the planes lie a pixel inside the guard band
  }
  for (std::size_t i = 1; i + 1 < n; ++i) add(projection, chunk, polygon[0], polygon[i], polygon[i + 1], id);
}

void TriangleSetup::sort_by_tile(TriangleChunk& chunk, const Tiling& tiling) const {
  chunk.tiles.clear();
  chunk.begin.clear();
  chunk.members.clear();
  chunk.count.resize(static_cast<std::size_t>(tiling.count()), 0);  // zero between calls
  const auto each_tile = [&](const PixelTriangle& t, auto&& visit) {
    for (int row = t.y0 / tile_side - tiling.first_row(); row <= t.y1 / tile_side - tiling.first_row(); ++row) {
      for (int column = t.x0 / tile_side; column <= t.x1 / tile_side; ++column) {
        visit(static_cast<std::uint32_t>(row * tiling.columns() + column));
      }
    }
  };
  for (const PixelTriangle& t : chunk.triangles) {
    each_tile(t, [&](std::uint32_t tile) {
      if (chunk.count[tile]++ == 0) chunk.tiles.push_back(tile);
    });
  }
  std::sort(chunk.tiles.begin(), chunk.tiles.end());
  std::uint32_t total = 0;
  for (const std::uint32_t tile : chunk.tiles) {
    chunk.begin.push_back(total);
    const std::uint32_t here = chunk.count[tile];
    chunk.count[tile] = total;
    total += here;
  }
  chunk.begin.push_back(total);
  chunk.members.resize(total);
  for (std::uint32_t i = 0; i < chunk.triangles.size(); ++i) {
    each_tile(chunk.triangles[i], [&](std::uint32_t tile) { chunk.members[chunk.count[tile]++] = i; });
  }
  for (const std::uint32_t tile : chunk.tiles) chunk.count[tile] = 0;
}

std::span<const std::uint32_t> TriangleChunk::of_tile(std::uint32_t tile) const {
  const auto at = std::lower_bound(tiles.begin(), tiles.end(), tile);
  if (at == tiles.end() || *at != tile) return {};
  const auto k = static_cast<std::size_t>(at - tiles.begin());
  return std::span(members).subspan(begin[k], begin[k + 1] - begin[k]);
}

void TriangleSetup::run(const SurfaceVisibility& a, Rows rows, std::span<const float> positions,
                        std::span<const std::uint32_t> triangles, Workers& workers) {
  const Tiling tiling{a.view.extent, rows};
  const Projection projection(a, tiling);
  const std::size_t vertices = positions.size() / 3, count = triangles.size() / 4;
  vertices_.resize(vertices);
  // Loops are handed on by reference: copies of what they hold would be allocated.
  const auto transform = [&](int b, int) {
    const std::size_t first = static_cast<std::size_t>(b) * block, last = std::min(vertices, first + block);
    for (std::size_t i = first; i < last; ++i) vertices_[i] = projection.camera_frame(&positions[i * 3]);
  };
  workers.each(static_cast<int>((vertices + block - 1) / block), std::cref(transform));
  used_ = (count + chunk_size - 1) / chunk_size;
  if (chunks_.size() < used_) chunks_.resize(used_);
  const auto project = [&](int c, int) {
    TriangleChunk& chunk = chunks_[static_cast<std::size_t>(c)];
    chunk.triangles.clear();
    chunk.dropped = 0;
    const std::size_t first = static_cast<std::size_t>(c) * chunk_size, last = std::min(count, first + chunk_size);
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t* corner = &triangles[i * 4];
      const Vertex &v0 = vertices_[corner[0]], &v1 = vertices_[corner[1]], &v2 = vertices_[corner[2]];
      const std::size_t before = chunk.triangles.size();
      if (v0.inside && v1.inside && v2.inside) {
        add(projection, chunk, v0, v1, v2, static_cast<std::uint32_t>(i));
      } else if (v0.z >= projection.near() || v1.z >= projection.near() || v2.z >= projection.near()) {
        clip(projection, chunk, v0, v1, v2, static_cast<std::uint32_t>(i));
      }
      if (chunk.triangles.size() == before) ++chunk.dropped;
    }
    sort_by_tile(chunk, tiling);
  };
  workers.each(static_cast<int>(used_), std::cref(project));
}

}  // namespace airlight
