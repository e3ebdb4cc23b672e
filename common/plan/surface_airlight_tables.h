// The tables of common/formulas/surface_airlight.h, where their layout is told.
#pragma once

#include <cstddef>
#include <vector>

#include "common/algorithms/view.h"

namespace airlight {

constexpr int surface_airlight_depths = 48, surface_airlight_angles = 128;  // nodes of the two axes
constexpr std::size_t surface_airlight_floats =
    4 + 2 * static_cast<std::size_t>(surface_airlight_angles) *
            (surface_airlight_depths + 1);  // a table; half is unused without light that scatters back

// Exponents of the materials that reflect specularly, each once, ascending.
std::vector<float> shininess_of(const std::vector<Material>&);
void find_shininess(const std::vector<Material>&, std::vector<float>& found);  // into memory that is there

// One table after the other: Lambert, then Phong for each exponent (0..1e4). Computed in double.
std::vector<float> surface_airlight_tables(Phase, const std::vector<float>& shininess);

}  // namespace airlight
