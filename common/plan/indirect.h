// Indirect single scattering on surfaces, as techniques add it to their plans.
#pragma once

#include <cstdint>

#include "common/plan/images.h"
#include "common/scene/scene.h"
#include "common/techniques/technique.h"

namespace airlight {

// `indirect`: unbounded | off.
Knob indirect_knob();

// The step and its tables, where the scene has something to scatter and to receive and the knob asks for it, else the reason why
// not among the skips. `given` brings what the step reads; tables, materials, medium and the image itself are filled in. Returns
// the image, absent without the step.
Image add_indirect(const Scene&, const FrameRequest&, SurfaceAirlight given, std::uint32_t tables_id, Images&, Plan&);

}  // namespace airlight
