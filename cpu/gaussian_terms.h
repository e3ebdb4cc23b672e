// What of a Gaussian is the same for all rays, computed once a tile.
#pragma once

#include <glm/vec3.hpp>

namespace airlight {

struct GaussianTerms {
  float inverse;       // of its radius [1/m]
  float length;        // optical depth of the line through its centre, beside its extinction [m]
  float whole;         // that optical depth
  glm::vec3 emission;  // beside its extinction [W/m^2/sr]
};

}  // namespace airlight
