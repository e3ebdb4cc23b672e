// Airlight of every second or fourth pixel, and what is between them.
#pragma once

#include <cstdint>

#include "common/plan/frame.h"

namespace airlight {

// `airlight_resolution`: full | half | quarter, of sample_airlight().
Knob airlight_resolution_knob();

// The last step of the plan is GaussianAirlight or RayMarch and makes airlight and transmittance of every pixel. By the knob it
// is turned into five: that of a few pixels (Subsample), what they tell of the others (DepthAwareUpsample), that of the remaining
// ones, and both together (FillAirlight); what the medium scatters of an environment is added to both before. Where nothing is
// gained by it, it stays what it is, and the plan's skips tell why. An optical depth that is wanted is always that of each pixel.
// Uses `sampled_airlight_ids` handles of the technique's own, from `first_id` on.
void sample_airlight(FramePlan&, std::uint32_t first_id);
constexpr std::uint32_t sampled_airlight_ids = 18;

}  // namespace airlight
