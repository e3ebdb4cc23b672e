// Particles, lines and knobs for the shaders that include gpu/network.glsl.
#pragma once

#include <glm/vec4.hpp>

#include "common/algorithms/network.h"
#include "gpu/step_runner.h"

namespace airlight {

// Of a dispatch's list, as its shader counts them.
constexpr std::size_t network_group = 64;

struct NetworkKnobs {
  std::int32_t particle_count = 1, line_count = 1, slots = 1, phase_kind = 0;
  float phase_g = 0, unit = 1, extinction = 0;
  std::int32_t samples = 1;
  glm::vec4 camera{0, 0, 0, 0};
};

// Binds what every step of a network reads.
template <class Algorithm>
void bind_network(StepRunner& r, const Algorithm& a, NetworkKnobs knobs) {
  knobs.particle_count = a.particle_count, knobs.line_count = a.line_count;
  r.block(knobs_binding, knobs);
  r.storage(1, a.particles);
  r.storage(2, a.lines);
}

}  // namespace airlight
