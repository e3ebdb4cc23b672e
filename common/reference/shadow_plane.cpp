#include "common/reference/shadow_plane.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

namespace airlight {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double in_line = 1e-13;  // sine of the angle below which the plane's normal would be rounding noise

bool precedes(const glm::dvec3& a, const glm::dvec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

}  // namespace

ShadowPlane::ShadowPlane(const glm::dvec3& origin, const glm::dvec3& direction, double length, const RelativeLight& light)
    : origin_(origin), along_(direction), directional_(light.directional) {
  const glm::dvec3 to_light = light.way_from(origin);
  const double along = glm::dot(direction, to_light);
  const glm::dvec3 across = to_light - along * direction;
  const double distance = glm::length(across);
  degenerate_ = distance <= in_line * glm::length(to_light);
  if (!directional_) foot_ = along;
  if (degenerate_) return;
  toward_ = across / distance;
  normal_ = glm::cross(along_, toward_);
  if (directional_) {
    height_ = infinity;
    cosine_ = along;
    sine_ = distance;
    before_ = {-sine_ * along_ + cosine_ * toward_, 0};
    behind_ = {sine_ * along_ - cosine_ * toward_, sine_ * length};
  } else {
    height_ = distance;
    const double far = std::hypot(foot_, height_);
    before_ = {(-height_ * along_ + foot_ * toward_) / far, 0};
    if (length < infinity) {
      const double end = std::hypot(length - foot_, height_);
      behind_ = {(height_ * along_ + (length - foot_) * toward_) / end, height_ * length / end};
    } else {
      behind_ = {toward_, height_};  // the line to the far end is parallel to the ray
    }
  }
}

bool ShadowPlane::meets(const Triangles::Box& box) const {
  const glm::dvec3 low(box.low[0], box.low[1], box.low[2]), high(box.high[0], box.high[1], box.high[2]);
  const glm::dvec3 middle = 0.5 * low + 0.5 * high - origin_, half = 0.5 * high - 0.5 * low;
  const auto reach = [&](const glm::dvec3& n) {
    return std::fabs(n.x) * half.x + std::fabs(n.y) * half.y + std::fabs(n.z) * half.z;
  };
  const auto outside = [&](const Side& s) { return glm::dot(s.normal, middle) - reach(s.normal) > s.bound; };
  if (std::fabs(glm::dot(normal_, middle)) > reach(normal_)) return false;
  const double y = glm::dot(toward_, middle), y_reach = reach(toward_);
  return y + y_reach >= 0 && y - y_reach <= height_ && !outside(before_) && !outside(behind_);
}

ShadowPlane::Point ShadowPlane::in_plane(const glm::dvec3& p) const { return {glm::dot(along_, p), glm::dot(toward_, p)}; }

// Both triangles at an edge compute its crossing from the same numbers in the same order.
ShadowPlane::Point ShadowPlane::crossing(const glm::dvec3& a, double side_a, const glm::dvec3& b, double side_b) const {
  if (precedes(b, a)) return crossing(b, side_b, a, side_a);
  const Point p = in_plane(a), q = in_plane(b);
  const double s = side_a / (side_a - side_b);
  return {p.x + s * (q.x - p.x), p.y + s * (q.y - p.y)};
}

// Widens `shadow` by that of the segment pq: only what lies between ray and light throws one.
void ShadowPlane::add_shadow(Point p, Point q, Interval& shadow) const {
  if (precedes({q.x, q.y, 0}, {p.x, p.y, 0})) std::swap(p, q);
  if (std::max(p.y, q.y) < 0 || std::min(p.y, q.y) >= height_) return;
  const auto at_height = [&](double y) { return p.x + (q.x - p.x) * ((y - p.y) / (q.y - p.y)); };
  for (const Point& end : {p, q}) {
    double t = 0;
    if (end.y < 0) {
      t = at_height(0);
    } else if (end.y >= height_) {
      t = at_height(height_) > foot_ ? infinity : -infinity;
    } else if (directional_) {
      t = end.x - end.y * (cosine_ / sine_);
    } else {
      t = foot_ + (end.x - foot_) * (height_ / (height_ - end.y));
    }
    shadow.first = std::min(shadow.first, t);
    shadow.second = std::max(shadow.second, t);
  }
}

Interval ShadowPlane::shadow(const glm::dvec3& pa, const glm::dvec3& pb, const glm::dvec3& pc) const {
  const glm::dvec3 a = pa - origin_, b = pb - origin_, c = pc - origin_;
  const glm::dvec3* corner[3] = {&a, &b, &c};
  const double side[3] = {glm::dot(normal_, a), glm::dot(normal_, b), glm::dot(normal_, c)};
  Point points[6];
  int n = 0;
  for (int i = 0; i < 3; ++i) {
    const int k = (i + 1) % 3;
    if (side[i] == 0) points[n++] = in_plane(*corner[i]);
    if ((side[i] < 0 && side[k] > 0) || (side[i] > 0 && side[k] < 0)) {
      points[n++] = crossing(*corner[i], side[i], *corner[k], side[k]);
    }
  }
  Interval shadow{infinity, -infinity};
  for (int i = 0; i < n; ++i) {
    for (int k = i + 1; k < n; ++k) add_shadow(points[i], points[k], shadow);
  }
  return shadow;
}

}  // namespace airlight
