// Functions of the angle from an axis by their harmonics y_l0 of the bands 0..5 (common/formulas/spherical_harmonics.h).
#pragma once

#include <array>

#include "common/algorithms/view.h"

namespace airlight {

using Zonal = std::array<double, 6>;

// The normalised point spread function of light that scatters once isotropically, gamma [rad] in 0..pi between its ways before
// and after [1/sr] (Zhou et al. 2007, eq. 18; Sun et al. 2005): its integral is 1.18.
double npsf(double gamma);
Zonal npsf_coefficients();

// Of a phase function, whose integral is 1; within 1e-6.
Zonal phase_coefficients(const Phase&);

}  // namespace airlight
