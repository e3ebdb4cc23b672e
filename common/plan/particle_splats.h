// What the camera sees of an illumination network's particles.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/algorithms/network_iteration.h"
#include "common/plan/frame.h"
#include "common/plan/network.h"

namespace airlight {

// `splat_radius`: of add_particle_splats().
Knob splat_radius_knob();

// A splat a particle, as common/algorithms/particle_splats.h lays them out, the nearest to `camera` [m] first, of equally near
// ones that of the lower number. Each stands for an equal share of `mass` (extinction integrated over the medium [m^2]), spread
// over 2 `radius` (n / 1024)^(1/6) times the distance between n particles there, (share / extinction)^(1/3), at most over four
// times what that is of their mean extinction (the few that are thinner would cover as much of the screen as a fifth of all), nor
// more than half the lattice. (Not in proportion to that distance: the image is of two dimensions, so that the noise of splats on
// a ray would fall by n^(-1/6) alone, the blur by n^(-2/3). So both fall by n^(-1/3).)
std::vector<float> particle_splats(const std::vector<float>& particles, const NetworkFrame&, double mass, double radius,
                                   const glm::dvec3& camera);

// Those that the squares of the screen meet, nearest first (common/plan/gaussian_bins.h). Throws InputError as gaussian_bins().
std::vector<std::int32_t> splat_bins(const View&, const std::vector<float>& splats);

// Adds ParticleSplats of an iteration's sources and its uploads, and before it the airlight of the homogeneous part, as far as
// there is one, seen through the medium: four handles from `first_id` on. `march`: that airlight's step, of which what the plan
// makes is filled in. Throws InputError where splats cannot give what is asked for.
void add_particle_splats(FramePlan&, const NetworkIteration&, const Plan::Upload& particles, const NetworkFrame&, RayMarch march,
                         std::uint32_t first_id);
constexpr std::uint32_t particle_splats_ids = 4;

}  // namespace airlight
