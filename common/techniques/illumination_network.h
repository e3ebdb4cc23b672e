#pragma once

#include "common/techniques/technique.h"

namespace airlight {

// Multiple scattering in Gaussians and grids, by an illumination network of particles (Szirmay-Kalos et al. 2005).
Technique illumination_network();

}  // namespace airlight
