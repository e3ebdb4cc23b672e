#include "common/plan/network_steps.h"

#include <cmath>
#include <glm/common.hpp>
#include <span>
#include <string>
#include <string_view>

#include "common/algorithms/particle_light.h"
#include "common/algorithms/source_function.h"
#include "common/algorithms/visibility_network.h"
#include "common/error.h"
#include "common/plan/environment.h"
#include "common/plan/hash.h"
#include "common/plan/source_nodes.h"
#include "common/plan/upload.h"
#include "common/plan/voxels.h"

namespace airlight {

namespace {

// Lines a quarter closer than particles in a list: of windows from 0.6 to 2 times the cube root that leaves the least error.
int window_of(int particles) {
  int side = 1;
  while (side * side * side + (side + 1) * (side + 1) * (side + 1) < particles * (2 * 125) / 64) ++side;
  return side;
}

// Throws InputError where the steps would hand on more than 2 GiB, of which the CPU takes about three times as much in all; then
// every index fits 32 bits, too.
void refuse_size(int particles, std::size_t directions, std::size_t floats) {
  constexpr std::size_t most_floats = std::size_t{1} << 29U;
  if (floats > most_floats)
    throw InputError("setting particles: the network of " + std::to_string(particles) + " particles and " +
                     std::to_string(directions) + " directions would take " + std::to_string(floats >> 18U) +
                     " MiB, expected at most " + std::to_string(most_floats >> 18U));
}

// Throws InputError where Gaussians are not all of the medium, or are too many to be a particle each.
int count_of(const Scene& scene, ParticleSet set, int sampled) {
  if (set == ParticleSet::sampled) return sampled;
  const auto refuse = [](const std::string& what) {
    throw InputError("setting particle_set: gaussians " + what + ", or particle_set=sampled");
  };
  if (scene.medium.grid) refuse("leave the grid without particles; expected a medium of Gaussians alone");
  const int count = gaussian_particles(scene);
  if (count > most_particles)
    refuse("would be " + std::to_string(count) + " particles; expected at most " + std::to_string(most_particles));
  return count;
}

std::string_view reason_of(const NetworkIteration& iteration, const KnobValues& knobs) {
  if (iteration.gradients) return "light from particle to particle, by conjugate gradients: the phase function is isotropic";
  return knobs.choice("acceleration") == "off"
             ? "light from particle to particle, an order of scattering a round"
             : "light from particle to particle, an order of scattering a round: the phase function depends on the direction";
}

std::string_view reason_of(const SourceNodes& nodes) {
  if (nodes.too_coarse) {
    return "what there is to scatter toward the camera; nodes miss most of what is narrower than the cells, and much light with "
           "it: a larger resolution helps";
  }
  return nodes.filled.size() > 1 ? "what there is to scatter toward the camera, in bricks where any of the medium is"
                                 : "what there is to scatter toward the camera, everywhere";
}

}  // namespace

NetworkPlan add_network(FramePlan& frame, Buffer voxels, bool splatted, std::uint32_t first_id) {
  const std::uint32_t particles_id = first_id, links_id = first_id + 2, first_light_id = first_id + 3,
                      particle_sources_id = first_id + 4, residuals_id = first_id + 5, sources_id = first_id + 6,
                      sky_id = first_id + 7;
  const Scene& scene = frame.scene;
  const KnobValues& knobs = frame.request.knobs;
  const Medium& medium = scene.medium;
  const ParticleSet particle_set = knobs.choice("particle_set") == "gaussians" ? ParticleSet::gaussians : ParticleSet::sampled;
  const int particles = count_of(scene, particle_set, static_cast<int>(knobs.number("particles")));
  const int lines = (static_cast<int>(knobs.number("directions")) + 1) / 2, window = window_of(particles);
  const int iterations = static_cast<int>(knobs.number("iterations"));
  const DirectionSet set = knobs.choice("direction_set") == "random" ? DirectionSet::random : DirectionSet::fibonacci;
  const MediumBox box = medium_box(scene, static_cast<int>(knobs.number("resolution")));
  const NetworkFrame lattice = network_frame(box);
  const auto unit = static_cast<float>(lattice.unit);
  const bool isotropic = medium.phase.kind == PhaseKind::isotropic;
  const std::vector<Plan::Upload> uploads =
      network_uploads(scene, box, particles, lines, window, particles_id, set, particle_set);
  frame.plan.uploads.insert(frame.plan.uploads.end(), uploads.begin(), uploads.end());
  const std::vector<GaussianDensity> gaussians = gaussians_of(scene, lattice.middle);
  GridDensity grid;
  if (medium.grid) grid = grid_density(*medium.grid, lattice.middle);
  const auto bytes = [](std::size_t floats) { return sizeof(float) * floats; };

  VisibilityNetwork network{.particles = uploads[0].buffer,
                            .lines = uploads[1].buffer,
                            .voxels = voxels,
                            .gaussians = gaussians,
                            .grid = grid,
                            .particle_count = particles,
                            .line_count = lines,
                            .window = window,
                            .unit = unit,
                            .extinction = frame.extinction,
                            .links = {}};
  const std::size_t directions = 2 * static_cast<std::size_t>(lines);
  const std::size_t values = 4 * static_cast<std::size_t>(particles) * (isotropic ? 1 : directions);
  refuse_size(particles, directions, network.shape().links() + 2 * values);
  network.links = {{links_id}, bytes(network.shape().links())};
  frame.plan.steps.push_back(
      {network, particle_set == ParticleSet::sampled
                    ? "which particles light meets along each line, and what is between them"
                    : "which Gaussians, a particle each, light meets along each line, and what is between them"});

  // Published and off are the other techniques' step and nothing.
  Buffer sky;
  if (scene.environment && knobs.choice("environment_airlight") == "on") {
    Hash key;
    key.add(std::string_view("network sky"));
    key.add(environment_key(*scene.environment, {}));
    key.add(lines);
    key.add(static_cast<int>(set));
    frame.plan.uploads.push_back(
        table_upload({{sky_id}, bytes(8 * static_cast<std::size_t>(lines))}, key.value(),
                     [environment = *scene.environment, lines, set] { return network_sky(environment, lines, set); }));
    sky = frame.plan.uploads.back().buffer;
    frame.scatter_environment_in_fog_alone();
  }

  ParticleLight light{.particles = network.particles,
                      .lines = network.lines,
                      .voxels = voxels,
                      .lights = {},
                      .gaussians = gaussians,
                      .grid = grid,
                      .phase = medium.phase,
                      .particle_count = particles,
                      .line_count = lines,
                      .unit = unit,
                      .extinction = frame.extinction,
                      .first = {{first_light_id}, bytes(values)}};
  for (const std::size_t index : frame.light_index) light.lights.push_back(light_of(scene.lights[index], lattice.middle));
  frame.plan.steps.push_back({light, "what each particle scatters of the lights"});

  NetworkIteration iteration{.particles = network.particles,
                             .lines = network.lines,
                             .links = network.links,
                             .first = light.first,
                             .sky = sky,
                             .phase = medium.phase,
                             .particle_count = particles,
                             .line_count = lines,
                             .window = window,
                             .tolerance = static_cast<float>(knobs.number("tolerance")),
                             .iterations = iterations,
                             .gradients = isotropic && knobs.choice("acceleration") == "on",
                             .sources = {{particle_sources_id}, bytes(values)},
                             .residuals = {}};
  iteration.residuals = {{residuals_id}, bytes(iteration.residual_floats())};
  frame.plan.steps.push_back({iteration, reason_of(iteration, knobs)});

  NetworkPlan made;
  made.lattice = lattice, made.particles = uploads[0], made.iteration = iteration;
  if (splatted) {
    frame.plan.skips.push_back({Rule::splatted, "source_function", "image = splats: the particles themselves are seen"});
    return made;
  }
  SourceFunction source{.particles = network.particles,
                        .lines = network.lines,
                        .links = network.links,
                        .particle_sources = iteration.sources,
                        .sky = sky,
                        .phase = medium.phase,
                        .particle_count = particles,
                        .line_count = lines,
                        .window = window,
                        .unit = unit,
                        .sources = {}};
  if (!isotropic) source.camera = scene.camera.position - lattice.middle;
  const SourceNodes nodes = source_nodes(scene, lattice, static_cast<int>(knobs.number("resolution")));
  source.first = nodes.first, source.stride = nodes.stride;
  source.nodes = nodes.nodes, source.bricks = nodes.bricks, source.filled = nodes.filled;
  made.first = lattice.middle + glm::dvec3(nodes.first) * lattice.unit;
  made.spacing = glm::dvec3(nodes.stride * lattice.unit);
  source.sources = {{sources_id}, bytes(source.floats())};
  frame.plan.steps.push_back({source, reason_of(nodes)});
  made.sources = source.sources;
  return made;
}

}  // namespace airlight
