#include "common/plan/ray_noise.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/formulas/double.h"

namespace airlight {

RayNoise ray_noise(const Scene& scene) {
  const Noise& noise = scene.medium.noise;
  const bool any = std::any_of(scene.medium.gaussians.begin(), scene.medium.gaussians.end(),
                               [](const Gaussian& g) { return g.extinction > 0; });
  if (!(noise.amplitude > 0) || !any) return {};
  RayNoise seen;
  seen.amplitude = static_cast<float>(noise.amplitude);
  seen.scale = static_cast<float>(noise.scale);
  for (int k = 0; k < 3; ++k) {
    const double period = f64::noise_period(), at = scene.camera.position[k] / noise.scale + noise.offset[k];
    seen.offset[k] = static_cast<float>(at - period * std::floor(at / period));
  }
  return seen;
}

void widen(std::vector<GaussianDensity>& gaussians, const RayNoise& noise) {
  if (!(noise.amplitude > 0)) return;
  for (GaussianDensity& g : gaussians) {
    const double distance = glm::length(glm::dvec3(g.center)), radius = static_cast<double>(g.radius);
    const double most =
        std::sqrt(3.0) * f64::noise_bound() * static_cast<double>(noise.amplitude) * radius / std::max(distance, radius);
    // |a / |a| - d| <= 2 |a - d| / (|a| + 1) for a unit vector d (Dunkl and Williams 1964), and 2 at most.
    const double apart = most < 1 ? 2 * most / (2 - most) : 2;
    const double reach = static_cast<double>(g.reach);
    g.reach = static_cast<float>(reach + apart * (distance + reach) * (1 + 1e-6));
  }
}

std::optional<std::string> refuses_noise(const Scene& scene) {
  if (!(ray_noise(scene).amplitude > 0)) return std::nullopt;
  return "the scene has noise, which bends the rays of gaussian-airlight alone (an amplitude of 0 leaves it out)";
}

}  // namespace airlight
