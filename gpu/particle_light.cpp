#include <vector>

#include "gpu/medium.h"
#include "gpu/network.h"

namespace airlight {

void run(const ParticleLight& a, StepRunner& r, const Progress& progress) {
  constexpr GLuint arriving_number = 50;  // a buffer of this step
  loop_budget(a.gaussians, a.grid, a.light_steps, LightDepth::analytic, 1);
  std::vector<std::string> defines = bind_medium(r, a.gaussians, a.grid, a.voxels, a.light_steps, LightDepth::analytic);
  defines.push_back(r.lights(a.lights));
  bind_network(r, a,
               {.phase_kind = static_cast<std::int32_t>(a.phase.kind),
                .phase_g = static_cast<float>(a.phase.g),
                .unit = a.unit,
                .extinction = a.extinction});
  const auto particles = static_cast<std::size_t>(a.particle_count);
  const bool isotropic = a.phase.kind == PhaseKind::isotropic;
  r.storage(0, a.first);
  r.reserve(arriving_number, sizeof(float) * particles * std::max<std::size_t>(a.lights.size(), 1));
  r.bind(3, arriving_number);
  defines.push_back("ARRIVING");
  if (!a.lights.empty()) r.each(r.compute("gpu/particle_light.glsl", defines), particles * a.lights.size(), network_group);
  progress.check();
  defines.back() = "FIRST";
  const std::size_t directions = isotropic ? 1 : 2 * static_cast<std::size_t>(a.line_count);
  r.each(r.compute("gpu/particle_light.glsl", defines), particles * directions, network_group);
}

}  // namespace airlight
