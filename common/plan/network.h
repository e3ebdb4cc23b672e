// What an illumination network is made of: particles sampled from the medium, and bundles of lines through them.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "common/algorithms/network.h"
#include "common/plan/depth_volumes.h"
#include "common/plan/plan.h"
#include "common/scene/scene.h"

namespace airlight {

// The lattice on which particles stand: all of the box lies within it.
struct NetworkFrame {
  glm::dvec3 middle{0, 0, 0};  // [m]
  double unit = 1;             // [m]
};
NetworkFrame network_frame(const MediumBox&);

// Extinction of the scene's Gaussians and grid, integrated over space [m^2].
double network_mass(const Scene&, const NetworkFrame&);

// Where particles stand: sampled, in proportion to extinction, by a low-discrepancy sequence (Roberts 2018: powers of the root of
// x^4 = x + 1), always the same ones, each as much of the medium's mass; or in the middle of each of the scene's Gaussians, with
// its mass. Each has the albedo and the emission of all that is there.
enum class ParticleSet : int { sampled, gaussians };
// Of how many Gaussians there would be.
int gaussian_particles(const Scene&);

// `count` particles of the scene's Gaussians and grid, as common/algorithms/network.h lays them out, gaussian_particles() of a
// set of Gaussians. They stand along Morton's curve: of 100000 particles those of one list lie near each other in memory, which
// makes a round 1.5 times as fast.
std::vector<float> network_particles(const Scene&, const NetworkFrame&, int count, ParticleSet = ParticleSet::sampled);

// Directions of `count` bundles of lines, along which light goes both ways: a direction and its opposite are always taken
// together. Spherical Fibonacci points on half of the sphere, evenly spread with the opposite ones; or at random, as published,
// always the same ones, of which more begin with fewer.
enum class DirectionSet : int { fibonacci, random };
std::vector<glm::dvec3> network_directions(int count, DirectionSet = DirectionSet::fibonacci);

// The bundles, each with a window of window^2 pixels at most about the particles, which leaves out where none are.
std::vector<std::int32_t> network_lines(const std::vector<float>& particles, int count, int window,
                                        DirectionSet = DirectionSet::fibonacci);

// What comes of an environment along each bundle [W/m^2/sr], rgb and an unused float, that which goes along the lines first: the
// mean over the directions that are nearest to it, so that all of the environment comes, suns included. One of the random set
// that is so near to another that no cell of the sky is nearest to it has what is at itself.
std::vector<float> network_sky(const Environment&, int line_count, DirectionSet = DirectionSet::fibonacci);

// Both as uploads under two handles from `first_id` on.
std::vector<Plan::Upload> network_uploads(const Scene&, const MediumBox&, int particles, int lines, int window,
                                          std::uint32_t first_id, DirectionSet = DirectionSet::fibonacci,
                                          ParticleSet = ParticleSet::sampled);

}  // namespace airlight
