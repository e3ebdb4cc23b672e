// What of a Gaussian is the same for all rays, computed once a tile.
#pragma once

namespace airlight {

struct GaussianTerms {
  float inverse;  // of its radius [1/m]
  float whole;    // optical depth of the line through its centre
};

}  // namespace airlight
