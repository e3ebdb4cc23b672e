// The tables of surface_airlight_psf() (common/formulas/surface_airlight.h).
#pragma once

#include <cstddef>
#include <vector>

namespace airlight {

constexpr std::size_t surface_psf_floats = 6;  // a table

// One after the other: Lambert's, of the irradiance; Phong's for each exponent, of the normalised lobe. Per unit of I / l^2 (or
// E) and of albedo.
std::vector<float> surface_psf_tables(const std::vector<float>& shininess);

}  // namespace airlight
