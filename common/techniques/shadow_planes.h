#pragma once

#include "common/techniques/technique.h"

namespace airlight {

// Single scattering in a homogeneous medium: Biri, Michelin, Arques 2006, "Real-time single scattering with shadows". In this
// version without the shadows: casters are ignored, which explain() says.
Technique shadow_planes();

}  // namespace airlight
