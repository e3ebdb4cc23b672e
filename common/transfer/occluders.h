// What stands in the way of rays from surfaces to the sky: all triangles that cast shadows, in Embree, in single precision about
// the middle of them.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "common/scene/scene.h"

namespace airlight {

class Occluders {
 public:
  // Throws MachineError where Embree fails.
  explicit Occluders(const Scene&);
  ~Occluders();
  Occluders(const Occluders&) = delete;
  Occluders& operator=(const Occluders&) = delete;

  // [m] below which places are not told apart; and of the smallest caster from corner to corner of its box.
  double resolution() const { return resolution_; }
  double smallest() const { return smallest_; }

  // For each unit direction whether a caster stands there, as seen from a place; at most 16. Safe from many threads at once.
  unsigned hidden(const glm::dvec3& from, const glm::vec3* directions, unsigned count) const;

  // Whether a caster's box lies within `radius` of a place, and a corner of it at least `beside` off the plane through it.
  bool near(const glm::dvec3& place, double radius, const glm::dvec3& normal, double beside) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  glm::dvec3 middle_{0};
  double resolution_ = 0, smallest_ = 0;
};

}  // namespace airlight
