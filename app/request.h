// What render settings ask of a technique.
#pragma once

#include "app/airlight.h"
#include "common/techniques/technique.h"

namespace airlight {

// By name, by the scene, or the first that supports it. Throws InputError where none does.
const Technique& chosen_technique(const Scene&, const RenderSettings&);

// Throws InputError for a resolution, supersampling, setting or image that there is not.
FrameRequest request_for(const Technique&, const Scene&, const RenderSettings&);

}  // namespace airlight
