#include "app/view_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <numbers>

#include "common/design/screen.h"

namespace airlight {

namespace {

// A direction turned about `up` and toward it, kept 1 degree off the poles.
glm::dvec3 turn(const glm::dvec3& direction, const glm::dvec3& up, const glm::dvec2& angles) {
  constexpr double nearest_pole = std::numbers::pi / 180;
  const glm::dvec3 pole = glm::normalize(up);
  const double height = glm::clamp(glm::dot(direction, pole), -1.0, 1.0);
  const glm::dvec3 level = glm::normalize(direction - height * pole), side = glm::cross(level, pole);
  const double limit = std::numbers::pi / 2 - nearest_pole;
  const double elevation = glm::clamp(std::asin(height) + angles.y, -limit, limit);
  const glm::dvec3 heading = std::cos(angles.x) * level + std::sin(angles.x) * side;
  return std::cos(elevation) * heading + std::sin(elevation) * pole;
}

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
  bool empty() const { return !(low.x <= high.x); }
};

void add_surfaces(const Scene& scene, bool casters_only, Box& box) {
  for (const Surface& s : scene.surfaces) {
    if (casters_only && !s.casts_shadow) continue;
    for (const glm::vec3& p : s.mesh->positions) box.add(glm::dvec3(s.transform * glm::dvec4(glm::dvec3(p), 1.0)));
  }
}

}  // namespace

Camera orbited(Camera c, const glm::dvec2& angles) {
  const glm::dvec3 way = c.look_at - c.position;
  c.position = c.look_at - glm::length(way) * turn(glm::normalize(way), c.up, angles);
  return c;
}

Camera turned(Camera c, const glm::dvec2& angles) {
  const glm::dvec3 way = c.look_at - c.position;
  c.look_at = c.position + glm::length(way) * turn(glm::normalize(way), c.up, angles);
  return c;
}

Camera panned(Camera c, const glm::dvec2& by) {
  const Screen screen(c);
  const double scale = glm::distance(c.position, c.look_at) * screen.half_height();
  const glm::dvec3 shift = scale * (by.x * screen.right() + by.y * screen.up());
  c.position += shift, c.look_at += shift;
  return c;
}

Camera dollied(Camera c, double factor) {
  const glm::dvec3 way = c.look_at - c.position;
  const double distance = glm::clamp(glm::length(way) * factor, 1e-3, 1e7);
  c.position = c.look_at - distance * glm::normalize(way);
  return c;
}

Camera moved(Camera c, const glm::dvec3& by) {
  const Screen screen(c);
  const glm::dvec3 shift = by.x * screen.right() + by.y * screen.up() + by.z * screen.forward();
  c.position += shift, c.look_at += shift;
  return c;
}

Camera framing(const Scene& scene, double aspect) {
  Box box;
  add_surfaces(scene, true, box);
  for (const Gaussian& g : scene.medium.gaussians) box.add(g.center - g.radius), box.add(g.center + g.radius);
  if (scene.medium.grid) {
    const glm::dvec3 size(scene.medium.grid->voxels->size);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 at((corner & 1) != 0 ? size.x : 0, (corner & 2) != 0 ? size.y : 0, (corner & 4) != 0 ? size.z : 0);
      box.add(glm::dvec3(scene.medium.grid->transform * glm::dvec4(at, 1.0)));
    }
  }
  if (box.empty()) add_surfaces(scene, false, box);
  if (box.empty()) {
    for (const LightSource& l : scene.lights) {
      if (l.type == LightType::point) box.add(l.position - 1.0), box.add(l.position + 1.0);
    }
  }
  Camera c = scene.camera;
  if (box.empty()) return c;
  const Screen screen(c);
  const double narrow = screen.half_height() * std::min(1.0, aspect),
               radius = std::max(glm::distance(box.low, box.high) / 2, 1e-3);
  c.look_at = (box.low + box.high) / 2.0;
  c.position = c.look_at - (radius * std::sqrt(1 + 1 / (narrow * narrow))) * screen.forward();  // the sphere about the box
  return c;
}

}  // namespace airlight
