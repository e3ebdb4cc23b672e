#include "gpu/gaussian_mean_depth.h"

#include <glm/vec4.hpp>

#include "common/error.h"
#include "gpu/medium.h"

namespace airlight {

void bind_mean_depth(StepRunner& r, const std::vector<GaussianDensity>& all) {
  // Sums over harmonics go round less than a thousand times.
  if (all.size() > static_cast<std::size_t>(LoopBudget::most) - 1000) {
    throw MachineError("OpenGL: the light of an environment through " + std::to_string(all.size()) +
                       " Gaussians is more loops than a shader may run");
  }
  std::vector<glm::vec4> gaussians;
  for (const GaussianDensity& g : all) {
    gaussians.emplace_back(g.center, 1 / g.radius);
    gaussians.emplace_back(g.extinction * g.radius, 0, 0, 0);
  }
  if (gaussians.empty()) gaussians.emplace_back(0);
  r.storage(1, std::as_bytes(std::span(gaussians)));
}

}  // namespace airlight
