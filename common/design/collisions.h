// What particles bounce off: all surfaces of a scene.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/reference/triangles.h"
#include "common/scene/scene.h"

namespace airlight {

// Embree makes the hierarchy; hits are found in double, the same whatever hierarchy it makes.
class Collisions {
 public:
  explicit Collisions(const Scene&);

  struct Hit {
    double fraction = 1;   // of the way, 0..1
    glm::dvec3 normal{0};  // unit, against the way
  };
  // The first surface on the way from `from` to `from + way`.
  std::optional<Hit> first(const glm::dvec3& from, const glm::dvec3& way) const;

  // Goes along `way`, reflected where a surface is, and never through one; `velocity` is reflected with it and keeps `bounce` of
  // its speed at each.
  void move(glm::dvec3& position, glm::dvec3 way, glm::dvec3& velocity, double bounce) const;

 private:
  Triangles triangles_;
  double margin_ = 0;  // [m] kept from surfaces
};

}  // namespace airlight
