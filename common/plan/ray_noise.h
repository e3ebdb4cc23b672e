// Noise in a scene's Gaussians, as a step takes it (Zhou et al. 2007, section 5.5).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/algorithms/medium.h"
#include "common/scene/scene.h"

namespace airlight {

// Seen from the camera: the noise stands still in the world. Amplitude 0 where the scene has no noise, or nothing that it bends.
RayNoise ray_noise(const Scene&);

// How far what a ray meets of a Gaussian may lie off the ray itself, in addition to its reach: into `reach`.
void widen(std::vector<GaussianDensity>&, const RayNoise&);

// Why a technique that bends no rays cannot render the scene, or nothing.
std::optional<std::string> refuses_noise(const Scene&);

}  // namespace airlight
