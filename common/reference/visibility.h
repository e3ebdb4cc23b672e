// What stands where: nearest hits, blocked light, and the parts of a view ray that lie in shadow; all in double.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "common/reference/triangles.h"
#include "common/scene/scene.h"

namespace airlight {

struct Hit {
  double distance = 0;  // [m]
  std::uint32_t triangle = 0;
};

// [begin, end] on a ray, in metres from its origin; either may be infinite.
using Interval = std::pair<double, double>;

// A light relative to the camera. `vector`: position of a point light, unit direction of travel of a directional one.
struct RelativeLight {
  glm::dvec3 vector{0}, power{0};
  double radius = 1e-3;  // [m]
  bool directional = false;

  RelativeLight(const LightSource&, const glm::dvec3& camera);

  // To the position of a point light; of a directional one, a unit vector.
  glm::dvec3 way_from(const glm::dvec3& point) const { return directional ? -vector : vector - point; }
};

class Visibility {
 public:
  explicit Visibility(const Scene&);

  const Triangles& triangles() const { return triangles_; }

  static constexpr std::uint32_t no_triangle = 0xffffffff;

  // The nearest triangle but `own` on a ray from a point along a unit direction, no nearer than `from` [m]. Edges belong to both
  // their triangles, so that no ray slips between two of them; of equal distances the lower triangle wins.
  std::optional<Hit> nearest(const glm::dvec3& origin, const glm::dvec3& direction, double from,
                             std::uint32_t own = no_triangle) const;

  // [m] from a point along a unit direction to the nearest caster; infinite where there is none.
  double free_length(const glm::dvec3& point, const glm::dvec3& direction) const;

  // Whether a caster other than triangle `own` stands between a surface point and the light.
  bool blocked(const glm::dvec3& point, std::uint32_t own, const RelativeLight&) const;

  // The parts of the ray (origin, unit direction, 0..length) that casters keep the light from: sorted, disjoint, clipped to it.
  // Exact: each triangle cuts the plane through ray and light in a segment, which the light projects onto the ray.
  std::vector<Interval> shadows(const glm::dvec3& origin, const glm::dvec3& direction, double length, const RelativeLight&) const;

 private:
  template <class Counts>
  Hit first(const glm::dvec3& origin, const glm::dvec3& direction, double from, const Counts&) const;  // infinite: none
  std::vector<Interval> shadows_along_light(const glm::dvec3& origin, const glm::dvec3& direction, const RelativeLight&,
                                            double foot) const;
  bool casts(std::uint32_t triangle) const { return casts_[triangles_[triangle].surface]; }

  Triangles triangles_;
  std::vector<bool> casts_;  // a surface each
  bool any_caster_ = false;
};

}  // namespace airlight
