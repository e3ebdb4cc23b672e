#include "common/plan/shadow_quads.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "common/plan/silhouette.h"

namespace airlight {

namespace {

glm::dvec3 vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

ScreenFunction negative(const ScreenFunction& f) { return {{-f.c[0], -f.c[1], -f.c[2]}}; }

double largest(const ScreenFunction& f, Extent extent) {
  return std::fabs(f.c[0]) + std::fabs(f.c[1]) * extent.width + std::fabs(f.c[2]) * extent.height;
}

// Columns from..to of rows y0..y1 where f may be >= 0 somewhere; rounding errors included.
void narrow(const ScreenFunction& f, double slack, double y0, double y1, double& from, double& to) {
  const double most = f.c[0] + std::max(f.c[2] * y0, f.c[2] * y1) + slack;
  if (f.c[1] > 0) {
    from = std::max(from, -most / f.c[1]);
  } else if (f.c[1] < 0) {
    to = std::min(to, -most / f.c[1]);
  } else if (most < 0) {
    to = from - 1;
  }
}

}  // namespace

ScreenRays::ScreenRays(const View& view) : extent_(view.extent) {
  const double w = extent_.width, h = extent_.height, tan = static_cast<double>(view.tan_half_fov);
  step_ = 2 * tan / h;
  left_ = ((0.5 + static_cast<double>(view.offset.x)) * 2 / w - 1) * tan * w / h;
  top_ = (1 - (0.5 + static_cast<double>(view.offset.y)) * 2 / h) * tan;
  for (int c = 0; c < 3; ++c) {
    right_[c] = static_cast<double>(view.right[c]);
    up_[c] = static_cast<double>(view.up[c]);
    forward_[c] = static_cast<double>(view.forward[c]);
  }
}

ScreenFunction ScreenRays::along(const double (&w)[3]) const {
  const auto dot = [&](const double(&axis)[3]) { return axis[0] * w[0] + axis[1] * w[1] + axis[2] * w[2]; };
  const double x = dot(right_), y = dot(up_);
  return {{left_ * x + top_ * y + dot(forward_), step_ * x, -step_ * y}};
}

ScreenFunction ScreenRays::scaled(ScreenFunction f) const {
  const double most = largest(f, extent_);
  if (!(most > 1e-280)) return {{0, 0, 0}};
  for (double& c : f.c) c /= most;
  return f;
}

void ShadowQuads::make(const ScreenRays& rays, const ShadowLight& light, std::span<const ShadowEdge> edges, int side,
                       Rows wanted) {
  const Extent extent = rays.extent();
  wanted = within(wanted, extent.height);
  const int columns = (extent.width + side - 1) / side, first_row = wanted.first / side;
  const int rows = std::max((wanted.end + side - 1) / side - first_row, 0);
  quads.clear();
  begin.assign(static_cast<std::size_t>(columns * rows) + 1, 0);
  members.clear();
  const glm::dvec3 l = vector(light.vector);
  struct Span {
    std::uint32_t quad;
    int row, from, to;  // tiles
  };
  thread_local std::vector<Span> spans;  // kept for its memory alone, as `at` below
  spans.clear();
  const auto function = [&](const glm::dvec3& w) {
    const double values[3] = {w.x, w.y, w.z};
    return rays.along(values);
  };
  for (const ShadowEdge& edge : edges) {
    // With w = light.point: a point of the plane is (w - alpha - beta) l + alpha a + beta b, and for a ray d that meets it at z,
    // det(d, l, a) = beta D / z, -det(d, l, b) = alpha D / z, det(d, a, b) = (w - alpha - beta) D / z, D = det(l, a, b). The
    // plane is where alpha, beta >= 0 and 1 - alpha - beta <= 0 (for a directional light the last weight itself).
    const glm::dvec3 a = vector(edge.a), b = vector(edge.b), ab = glm::cross(a, b), la = glm::cross(l, a), lb = glm::cross(l, b);
    const int side_of_camera = beside(l, a, b);
    const double volume = side_of_camera * std::fabs(glm::dot(l, ab));
    ShadowQuad quad;
    quad.u = rays.scaled(function(side_of_camera > 0 ? la : lb));
    quad.v = rays.scaled(function(side_of_camera > 0 ? lb : la));
    quad.e = rays.scaled(function(ab));
    if (side_of_camera > 0) quad.e = negative(quad.e);
    quad.change = -side_of_camera * edge.multiplicity;
    // A plane through the camera is crossed at once: 1/z is 1e30 somewhere.
    quad.k = function(light.point * ab - lb + la);
    const double most = std::max(largest(quad.k, extent), 1e-280);
    for (double& c : quad.k.c) {
      c = std::fabs(volume) * 1e30 > most ? c / volume : side_of_camera * (c / most) * 1e30;
    }

    const ScreenFunction minus_v = negative(quad.v);
    const double slack = 1e-5, slack_k = 1e-5 * largest(quad.k, extent);  // floats on the way to the pixel; scaled() makes them 1
    const auto id = static_cast<std::uint32_t>(quads.size());
    bool seen = false;
    for (int row = 0; row < rows; ++row) {
      double from = 0, to = extent.width - 1;
      const double y0 = (first_row + row) * side, y1 = std::min(y0 + side, static_cast<double>(extent.height)) - 1;
      narrow(quad.u, slack, y0, y1, from, to);
      narrow(minus_v, slack, y0, y1, from, to);
      narrow(quad.e, slack, y0, y1, from, to);
      narrow(quad.k, slack_k, y0, y1, from, to);
      if (!(from <= to)) continue;
      seen = true;
      spans.push_back({id, row, static_cast<int>(from) / side, static_cast<int>(to) / side});
    }
    if (seen) quads.push_back(quad);
  }

  const auto tile_at = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  };
  for (const Span& s : spans) {
    for (int column = s.from; column <= s.to; ++column) ++begin[tile_at(column, s.row) + 1];
  }
  for (std::size_t t = 1; t < begin.size(); ++t) begin[t] += begin[t - 1];
  members.resize(begin.back());
  thread_local std::vector<std::uint32_t> at;
  at.assign(begin.begin(), begin.end() - 1);
  for (const Span& s : spans) {
    for (int column = s.from; column <= s.to; ++column) members[at[tile_at(column, s.row)]++] = s.quad;
  }
}

ShadowVolumesView::ShadowVolumesView(std::span<const std::byte> bytes, std::size_t count) {
  if (bytes.size() < count * sizeof(ShadowLight)) throw std::logic_error("shadow volumes: the buffer has too few lights");
  const auto rest = bytes.subspan(count * sizeof(ShadowLight));
  lights = {reinterpret_cast<const ShadowLight*>(bytes.data()), count};
  edges = {reinterpret_cast<const ShadowEdge*>(rest.data()), rest.size() / sizeof(ShadowEdge)};
}

TileCount count_tiles(const View& view, const ShadowVolumesView& volumes, int side) {
  const auto along = [side](int pixels) { return static_cast<std::size_t>((pixels + side - 1) / side); };
  std::vector<char> touched(along(view.extent.width) * along(view.extent.height));
  const ScreenRays rays(view);
  for (const ShadowLight& light : volumes.lights) {
    ShadowQuads quads;
    quads.make(rays, light, volumes.of(light), side);
    for (std::size_t t = 0; t < touched.size(); ++t) touched[t] |= !quads.of_tile(t).empty();
  }
  return {touched.size(), static_cast<std::size_t>(std::count(touched.begin(), touched.end(), 0))};
}

}  // namespace airlight
