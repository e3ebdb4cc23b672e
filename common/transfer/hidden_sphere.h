// What is hidden of the sphere of directions from one place of a surface.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/plan/surface_transfer.h"
#include "common/transfer/occluders.h"

namespace airlight {

// Directions all over the sphere, the same from every place, and their harmonics; of spherical Fibonacci points, each of which
// stands for the same solid angle. Told by + - * / and sqrt alone: the same on every machine.
class SphereOfDirections {
 public:
  explicit SphereOfDirections(int count);

  std::size_t size() const { return directions_.size(); }
  const glm::vec3& operator[](std::size_t i) const { return directions_[i]; }
  const std::array<float, 36>& basis(std::size_t i) const { return basis_[i]; }

 private:
  std::vector<glm::vec3> directions_;
  std::vector<std::array<float, 36>> basis_;
};

// One side of a place: SurfaceTransfer's record, or that nothing or everything is hidden.
struct HiddenSphere {
  std::uint32_t kind = SurfaceTransfer::nothing;  // or everything; else 0
  std::vector<float> record;                      // empty unless that is 0
};

// From a place a little off the surface, above the horizon of a unit normal. Everything is hidden where the first eighth of the
// rays says so: places inside of something need no more.
HiddenSphere hidden_sphere(const Occluders&, const SphereOfDirections&, const glm::dvec3& from, const glm::dvec3& normal);

// Of the light that a white surface would have reflected from a sky of radiance 1: how it changes with the sky's first four
// harmonics. Differences of it between places tell how differently they are lit.
glm::dvec4 hidden_share(const HiddenSphere&, const glm::dvec3& normal);

}  // namespace airlight
