// The tables of the boundary integrals of common/formulas/airlight.h, where their layout is told.
#pragma once

#include <vector>

#include "common/algorithms/view.h"

namespace airlight {

// `nodes` (8..512) an axis; time grows with its square. Computed in double from the defining integrals.
std::vector<float> airlight_tables(Phase, int nodes);

}  // namespace airlight
