// Optical depths of Gaussians toward the lights: in volumes, or left to closed forms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/plan/light_volumes.h"

namespace airlight {

constexpr std::size_t few_gaussians = 16;  // that many stand in a light's way faster than a volume of their depths is made

// Adds the volumes where the knob `light_path` asks for them or, by `auto`, where they are worth it; `light_cells` of theirs in
// the radius of the smallest Gaussian. Else none, and a skip that says why. A handle for the extinction, and one a light from
// `depths_id` on. Throws InputError for volumes of too many cells.
LightVolumes add_gaussian_light_volumes(FramePlan&, const std::vector<GaussianDensity>&, std::uint32_t injected_id,
                                        std::uint32_t depths_id);

}  // namespace airlight
