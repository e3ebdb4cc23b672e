// What plain sums are made of, which share no code with the reference.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "common/image.h"
#include "common/scene/scene.h"

namespace airlight {

struct Corners {
  glm::dvec3 a, b, c;
};

inline std::vector<Corners> corners_of(const Surface& s) {
  std::vector<Corners> all;
  const auto at = [&](unsigned i) { return glm::dvec3(s.transform * glm::dvec4(s.mesh->positions[i], 1)); };
  for (const glm::uvec3& t : s.mesh->triangles) all.push_back({at(t.x), at(t.y), at(t.z)});
  return all;
}

// Moeller and Trumbore 1997: where o + t d meets the triangle; infinity where it does not.
inline double meets(const glm::dvec3& o, const glm::dvec3& d, const Corners& triangle) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const glm::dvec3 e = triangle.b - triangle.a, f = triangle.c - triangle.a, p = glm::cross(d, f);
  const double determinant = glm::dot(e, p);
  if (determinant == 0) return never;
  const glm::dvec3 from = o - triangle.a, q = glm::cross(from, e);
  const double u = glm::dot(from, p) / determinant, v = glm::dot(d, q) / determinant;
  return u < 0 || v < 0 || u + v > 1 ? never : glm::dot(f, q) / determinant;
}

// A scene of one lamp, asked point by point; every triangle is tried.
struct BruteForce {
  Scene scene;
  LightSource light;
  std::vector<Corners> triangles;

  explicit BruteForce(const Scene& s) : scene(s), light(s.lights.at(0)) {
    for (const Surface& one : s.surfaces) {
      for (const Corners& t : corners_of(one)) triangles.push_back(t);
    }
  }

  glm::dvec3 direction(const glm::dvec2& at, Extent extent) const {
    const Camera& camera = scene.camera;
    const glm::dvec3 forward = glm::normalize(camera.look_at - camera.position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
    const double tan = std::tan(camera.vertical_fov / 2 * std::numbers::pi / 180),
                 aspect = static_cast<double>(extent.width) / extent.height;
    return glm::normalize(forward + (2 * at.x / extent.width - 1) * tan * aspect * right +
                          (1 - 2 * at.y / extent.height) * tan * up);
  }

  bool lit(const glm::dvec3& x) const { return sees(x, light.position); }

  // Whether nothing stands between two points.
  bool sees(const glm::dvec3& x, const glm::dvec3& y) const {
    return std::none_of(triangles.begin(), triangles.end(), [&](const Corners& t) {
      const double at = meets(x, y - x, t);
      return at > 1e-9 && at < 1;
    });
  }

  double density(const Gaussian& g, const glm::dvec3& x) const {
    const glm::dvec3 p = (x - g.center) / g.radius;
    return std::exp(-glm::dot(p, p));
  }

  double depth_to_light(const glm::dvec3& x) const { return depth(x, light.position); }

  double depth(const glm::dvec3& x, const glm::dvec3& y) const {
    const glm::dvec3 way = y - x;
    const double length = glm::length(way);
    double sum = scene.medium.extinction * length;
    for (const Gaussian& g : scene.medium.gaussians) {
      const glm::dvec3 to_center = g.center - x;
      const double foot = glm::dot(to_center, way) / length;
      const double h = glm::length(glm::cross(to_center, way)) / length;
      sum += g.extinction * std::exp(-h * h / (g.radius * g.radius)) * g.radius * std::sqrt(std::numbers::pi) / 2 *
             (std::erf((length - foot) / g.radius) - std::erf(-foot / g.radius));
    }
    return sum;
  }

  // Light that arrives at x on a facing plane, per unit of intensity, shadows left out.
  double arriving(const glm::dvec3& x) const {
    const double r = std::max(glm::distance(light.position, x), light.radius);
    return std::exp(-depth_to_light(x)) / (r * r);
  }
};

}  // namespace airlight
