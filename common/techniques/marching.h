#pragma once

#include "common/techniques/technique.h"

namespace airlight {

// Ray marching: what one writes first for any medium, and what the other techniques are measured against. Second order in its
// steps; the peak of a point light and the fade inside a step are integrated.
Technique marching();

}  // namespace airlight
