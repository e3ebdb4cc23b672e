#include "common/reference/visibility.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "common/reference/shadow_plane.h"

namespace airlight {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Signed volume of direction and edge; exactly the opposite when the edge runs the other way, so that neighbours agree.
double beside(const glm::dvec3& d, const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(d, glm::cross(a, b)); }

// Where the line o + t d meets triangle abc (edges included), in units of |d|; NaN where it does not.
double line_triangle(const glm::dvec3& o, const glm::dvec3& d, const glm::dvec3& pa, const glm::dvec3& pb, const glm::dvec3& pc) {
  const glm::dvec3 a = pa - o, b = pb - o, c = pc - o;
  const double u = beside(d, b, c), v = beside(d, c, a), w = beside(d, a, b);
  const bool hit = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double slope = glm::dot(n, d);
  if (!hit || slope == 0) return std::numeric_limits<double>::quiet_NaN();
  return glm::dot(n, a) / slope;
}

// Box test of the line o + t d, t in from..to.
struct LineMeets {
  glm::dvec3 o, inverse;
  double from;
  const double& to;

  LineMeets(const glm::dvec3& origin, const glm::dvec3& d, double t0, const double& t1)
      : o(origin), inverse(1 / d.x, 1 / d.y, 1 / d.z), from(t0), to(t1) {}
  bool operator()(const Triangles::Box& box) const {
    double t0 = from, t1 = to;
    for (int c = 0; c < 3; ++c) {
      const auto k = static_cast<std::size_t>(c);
      const double p = (static_cast<double>(box.low[k]) - o[c]) * inverse[c];
      const double q = (static_cast<double>(box.high[k]) - o[c]) * inverse[c];
      // 0 * infinity (a line in the face's own plane) is NaN and changes nothing.
      t0 = std::min(p, q) > t0 ? std::min(p, q) : t0;
      t1 = std::max(p, q) < t1 ? std::max(p, q) : t1;
    }
    return t0 <= t1;
  }
};

}  // namespace

RelativeLight::RelativeLight(const LightSource& light, const glm::dvec3& camera)
    : vector(light.type == LightType::directional ? glm::normalize(light.direction) : light.position - camera),
      power(light.power),
      radius(light.radius),
      directional(light.type == LightType::directional) {}

Visibility::Visibility(const Scene& scene) : triangles_(scene) {
  for (const Surface& s : scene.surfaces) {
    casts_.push_back(s.casts_shadow);
    any_caster_ = any_caster_ || s.casts_shadow;
  }
}

template <class Counts>
Hit Visibility::first(const glm::dvec3& origin, const glm::dvec3& direction, double from, const Counts& counts) const {
  Hit best{infinity, 0};
  triangles_.walk(LineMeets(origin, direction, from, best.distance), [&](std::uint32_t i) {
    if (!counts(i)) return true;
    const auto& t = triangles_[i];
    const double at =
        line_triangle(origin, direction, triangles_.position(t, 0), triangles_.position(t, 1), triangles_.position(t, 2));
    if (at >= from && (at < best.distance || (at == best.distance && i < best.triangle))) best = {at, i};
    return true;
  });
  return best;
}

std::optional<Hit> Visibility::nearest(const glm::dvec3& origin, const glm::dvec3& direction, double from,
                                       std::uint32_t own) const {
  const Hit best = first(origin, direction, from, [&](std::uint32_t i) { return i != own; });
  if (best.distance == infinity) return std::nullopt;
  return best;
}

double Visibility::free_length(const glm::dvec3& point, const glm::dvec3& direction) const {
  if (!any_caster_) return infinity;
  return first(point, direction, 0, [&](std::uint32_t i) { return casts(i); }).distance;
}

bool Visibility::blocked(const glm::dvec3& point, std::uint32_t own, const RelativeLight& light) const {
  if (!any_caster_) return false;
  const glm::dvec3 way = light.way_from(point);
  const double length = glm::length(way);
  if (length == 0) return false;
  // Triangles that share an edge or vertex with this one touch the ray at its start.
  const double from = 1e-9 * glm::length(point) / length;
  const double to = light.directional ? infinity : 1 - 1e-12;
  bool found = false;
  triangles_.walk(LineMeets(point, way, from, to), [&](std::uint32_t i) {
    if (i == own || !casts(i)) return true;
    const auto& t = triangles_[i];
    const double at = line_triangle(point, way, triangles_.position(t, 0), triangles_.position(t, 1), triangles_.position(t, 2));
    found = at > from && at < to;
    return !found;
  });
  return found;
}

std::vector<Interval> Visibility::shadows(const glm::dvec3& origin, const glm::dvec3& direction, double length,
                                          const RelativeLight& light) const {
  if (!any_caster_ || !(length > 0)) return {};
  const ShadowPlane plane(origin, direction, length, light);
  std::vector<Interval> found;
  if (plane.degenerate()) {
    found = shadows_along_light(origin, direction, light, plane.foot());
  } else {
    triangles_.walk([&](const Triangles::Box& box) { return plane.meets(box); },
                    [&](std::uint32_t i) {
                      if (!casts(i)) return true;
                      const auto& t = triangles_[i];
                      const Interval shadow =
                          plane.shadow(triangles_.position(t, 0), triangles_.position(t, 1), triangles_.position(t, 2));
                      if (shadow.first < length && shadow.second > 0) found.push_back(shadow);
                      return true;
                    });
  }

  // Neighbouring triangles leave no gap between their shadows: gaps of rounding size are closed.
  std::sort(found.begin(), found.end());
  std::vector<Interval> merged;
  for (Interval s : found) {
    s = {std::max(s.first, 0.0), std::min(s.second, length)};
    if (!merged.empty() && s.first <= merged.back().second * (1 + 1e-12)) {
      merged.back().second = std::max(merged.back().second, s.second);
    } else if (s.first < s.second) {
      merged.push_back(s);
    }
  }
  return merged;
}

// The ray and the light in one line: a caster across it at t darkens all that lies behind it as seen from the light.
std::vector<Interval> Visibility::shadows_along_light(const glm::dvec3& origin, const glm::dvec3& direction,
                                                      const RelativeLight& light, double foot) const {
  const double source = light.directional ? (glm::dot(light.vector, direction) < 0 ? infinity : -infinity) : foot;
  std::vector<Interval> found;
  triangles_.walk(LineMeets(origin, direction, -infinity, infinity), [&](std::uint32_t i) {
    if (!casts(i)) return true;
    const auto& t = triangles_[i];
    const double at =
        line_triangle(origin, direction, triangles_.position(t, 0), triangles_.position(t, 1), triangles_.position(t, 2));
    if (at < source) found.emplace_back(-infinity, at);
    if (at > source) found.emplace_back(at, infinity);
    return true;
  });
  return found;
}

}  // namespace airlight
