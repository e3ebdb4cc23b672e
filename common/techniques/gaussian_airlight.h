#pragma once

#include "common/techniques/technique.h"

namespace airlight {

// Single scattering in sums of Gaussians and homogeneous fog with closed forms of optical depth: Zhou, Hou, Gong, Snyder, Guo,
// Shum 2007, "Fogshop: real-time design and rendering of inhomogeneous, single-scattering media".
Technique gaussian_airlight();

}  // namespace airlight
