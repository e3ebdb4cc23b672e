// The tables of the boundary integrals of common/formulas/airlight.h, where their layout is told.
#pragma once

#include <cstddef>
#include <vector>

#include "common/algorithms/view.h"

namespace airlight {

// Nodes an axis, 8..512: `nodes` for a smooth phase function, up to four times as many for a peak.
int airlight_table_nodes(Phase, int nodes);

// How many floats airlight_tables() gives.
std::size_t airlight_table_floats(Phase, int nodes);

// airlight_table_nodes() an axis; time grows with its square. Computed in double from the defining integrals.
std::vector<float> airlight_tables(Phase, int nodes);

}  // namespace airlight
