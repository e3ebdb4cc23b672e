// Optical depths of Gaussians from one place, or from infinity, to the centres of all: T(v, b_i) and T(s, b_i) of Zhou, Hou,
// Gong, Snyder, Guo, Shum 2007, "Fogshop", section 5.1. No libm: the same on every machine.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/algorithms/medium.h"
#include "common/algorithms/view.h"

namespace airlight {

// By number of the Gaussian at whose centre a way ends. Only those count of whose reach some place of the way is part.
struct CenterDepths {
  std::vector<double> own;     // of that Gaussian itself
  std::vector<double> others;  // of all but it: their sum with `own` would lose digits of what is small beside it
  std::uint64_t visited = 0;   // pairs of a way and a Gaussian that were looked at; beside n log n, what it costs
};

// From the origin, seen from which the Gaussians are told. By a sweep over the sphere of directions, on which each Gaussian's
// reach is a cone (their eq. 30) and each cone a box in height and angle about +Y: O(n log n + k), k pairs of a way and a box
// that it runs through. The same pairs count as if all were looked at, each by the formulas in single precision: 6e-7 of the
// whole lines through what is met, as tests/unit/depths_to_centers.cpp holds it against such a sum by the C library.
CenterDepths depths_to_centers(std::span<const GaussianDensity>);

// From where a directional light comes from, infinitely far away: by a sweep over the plane that faces it.
CenterDepths depths_to_centers(std::span<const GaussianDensity>, const glm::vec3& direction_of_travel);

// From the origin to a place, by all Gaussians.
double depth_to(std::span<const GaussianDensity>, const glm::dvec3& place);
// From the origin to infinity, by all Gaussians. `way`: unit.
double depth_toward(std::span<const GaussianDensity>, const glm::dvec3& way);

}  // namespace airlight
