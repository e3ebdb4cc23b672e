// What of a Gaussian is the same for all rays, computed once a tile.
#pragma once

namespace airlight {

struct GaussianTerms {
  float inverse;          // of its radius [1/m]
  float length;           // optical depth of the line through its centre, beside its extinction [m]
  float whole;            // that optical depth
  float over_extinction;  // 1 / extinction [m], finite
};

}  // namespace airlight
