// The step that renders Gaussians as Zhou et al. 2007 publish it, with the optical depths to centres that it reads.
#pragma once

#include <cstdint>
#include <vector>

#include "common/algorithms/medium.h"
#include "common/plan/frame.h"

namespace airlight {

constexpr std::uint32_t projected_gaussians_ids = 3;

// Adds ProjectedGaussians and its uploads, under so many ids from first_id on, and those of the lights, light_ids apart. Depths
// from a light are told as it sees the Gaussians, those from the camera likewise: where only the other has moved they are those
// from before. `gaussians`: as the camera sees them, at least one. Throws InputError for what it does not know: surfaces that
// throw shadows (`volumes`), noise, a low resolution.
void add_projected_gaussians(FramePlan&, const std::vector<GaussianDensity>& gaussians, Erf, Buffer tables, Buffer volumes,
                             std::uint32_t first_id, std::uint32_t light_id);

}  // namespace airlight
