// The settings of what every technique for uneven media makes of surfaces and environments.
#pragma once

#include <vector>

#include "common/plan/frame.h"

namespace airlight {

// A technique's own knobs, then theirs; `environment` is `environment_airlight`, of which a technique may know more.
std::vector<Knob> with_surface_knobs(std::vector<Knob> own, const Knob& environment = environment_knob());

}  // namespace airlight
