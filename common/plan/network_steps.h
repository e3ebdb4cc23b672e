// The steps of an illumination network: who sees whom, what the lights bring, how light goes round, and the source function.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "common/algorithms/network_iteration.h"
#include "common/plan/frame.h"
#include "common/plan/network.h"

namespace airlight {

// The network of a scene with Gaussians or a grid, and what the steps after it read.
struct NetworkPlan {
  NetworkFrame lattice;
  Plan::Upload particles;
  NetworkIteration iteration;
  Buffer sources;             // absent where particles are splatted
  glm::dvec3 first{0, 0, 0};  // [m] in the world
  glm::dvec3 spacing{1, 1, 1};
};

// Of any set.
constexpr int most_particles = 100000;

// Adds them to the plan of a technique with the knobs `particles particle_set directions direction_set iterations tolerance
// acceleration resolution environment_airlight`; without the source function where particles are `splatted`. `voxels`: the
// scene's grid, if it has one. Handles: network_ids from `first_id` on. Throws InputError where the steps would hand on more than
// 2 GiB.
NetworkPlan add_network(FramePlan&, Buffer voxels, bool splatted, std::uint32_t first_id);
constexpr std::uint32_t network_ids = 8;

}  // namespace airlight
