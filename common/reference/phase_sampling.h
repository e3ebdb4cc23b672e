// Random directions that follow a phase function.
#pragma once

#include <glm/vec3.hpp>

#include "common/algorithms/view.h"
#include "common/random.h"

namespace airlight {

struct ScatteredDirection {
  glm::dvec3 direction{0};  // unit
  double weight = 1;  // phase function over the density [1/sr] that it was drawn with: 1 but for Cornette and Shanks, below 1.5
};

// From a unit direction of travel; two numbers, of Rayleigh and Mie three.
ScatteredDirection scattered_direction(const Phase&, const glm::dvec3& direction, Random&);

}  // namespace airlight
