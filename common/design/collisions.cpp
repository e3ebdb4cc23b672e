#include "common/design/collisions.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace airlight {

namespace {

// Positions about the world's origin, wherever the camera is.
Scene about_origin(const Scene& scene) {
  Scene s;
  s.surfaces = scene.surfaces;
  s.camera.position = {0, 0, 0};
  return s;
}

constexpr double edge = 1e-9;    // triangles are larger by that share, so that nothing slips between neighbours
constexpr int most_bounces = 8;  // on one way: in a wedge they have no end

bool meets(const Triangles::Box& box, const glm::dvec3& from, const glm::dvec3& way) {
  double low = 0, high = 1;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double a = static_cast<double>(box.low[i]) - from[k], b = static_cast<double>(box.high[i]) - from[k];
    if (way[k] == 0) {
      if (a > 0 || b < 0) return false;
      continue;
    }
    const double s = a / way[k], t = b / way[k];
    low = std::max(low, std::min(s, t)), high = std::min(high, std::max(s, t));
  }
  return low <= high * (1 + edge) + edge;
}

}  // namespace

Collisions::Collisions(const Scene& scene) : triangles_(about_origin(scene)) {
  double scale = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 p = glm::abs(triangles_.position(triangles_[i], k));
      scale = std::max({scale, p.x, p.y, p.z});
    }
  }
  margin_ = 1e-7 * scale;  // far above the rounding of a hit, far below what is seen
}

std::optional<Collisions::Hit> Collisions::first(const glm::dvec3& from, const glm::dvec3& way) const {
  std::optional<Hit> nearest;
  std::size_t which = 0;
  triangles_.walk(
      [&](const Triangles::Box& box) { return meets(box, from, way); },
      [&](std::size_t i) {
        const Triangles::Triangle& t = triangles_[i];
        const glm::dvec3 a = triangles_.position(t, 0) - from, e = triangles_.position(t, 1) - triangles_.position(t, 0),
                         f = triangles_.position(t, 2) - triangles_.position(t, 0);
        const glm::dvec3 n = glm::cross(e, f);
        const double toward = glm::dot(n, way);
        if (toward == 0) return true;
        const double at = glm::dot(n, a) / toward;
        if (!(at >= 0 && at <= 1)) return true;
        // Where the way meets the plane, in the triangle's own coordinates.
        const glm::dvec3 p = at * way - a;
        const double area = glm::dot(n, n), u = glm::dot(glm::cross(p, f), n) / area, v = glm::dot(glm::cross(e, p), n) / area;
        if (!(u >= -edge && v >= -edge && u + v <= 1 + edge)) return true;
        // The order of the hierarchy says nothing: of two at the same place the first in the scene.
        if (nearest && (at > nearest->fraction || (at == nearest->fraction && i > which))) return true;
        nearest = Hit{at, n * ((toward > 0 ? -1.0 : 1.0) / std::sqrt(area))};
        which = i;
        return true;
      });
  return nearest;
}

void Collisions::move(glm::dvec3& position, glm::dvec3 way, glm::dvec3& velocity, double bounce) const {
  for (int k = 0; k < most_bounces; ++k) {
    const double length = glm::length(way);
    if (!(length > 0)) return;
    // Looks a margin further, so that nothing comes to stand in a surface.
    const auto hit = first(position, way * (1 + margin_ / length));
    if (!hit) {
      position += way;
      return;
    }
    // Back from the surface on the way that it came: nothing is there.
    const double gone = std::clamp(hit->fraction * (length + margin_) - margin_, 0.0, length);
    position += way * (gone / length);
    way *= 1 - gone / length;
    way -= (2 * glm::dot(way, hit->normal)) * hit->normal;
    velocity = bounce * (velocity - (2 * glm::dot(velocity, hit->normal)) * hit->normal);
  }
}

}  // namespace airlight
