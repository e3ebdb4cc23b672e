#include "common/techniques/illumination_network.h"

#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <string>

#include "common/error.h"
#include "common/plan/environment.h"
#include "common/plan/frame.h"
#include "common/plan/hash.h"
#include "common/plan/network.h"
#include "common/plan/particle_splats.h"
#include "common/plan/ray_noise.h"
#include "common/plan/sampled_airlight.h"
#include "common/plan/upload.h"
#include "common/plan/voxels.h"

namespace airlight {

namespace {

std::optional<std::string> refuses(const Scene& scene) {
  if (scene.medium.gaussians.empty() && !scene.medium.grid)
    return "its particles stand for Gaussians and grids, the scene has neither";
  if (auto why = refuses_noise(scene)) return why;
  return refuses_environment(scene);
}

int window_of(int particles) {
  int side = 1;  // the nearest to the cube root: lists of that length
  while (side * side * side + (side + 1) * (side + 1) * (side + 1) < 2 * particles) ++side;
  return side;
}

Knob scattered_environment_knob() {
  Knob knob = environment_knob();
  knob.meaning =
      "an environment's light that Gaussians and grids scatter in all orders and fog once; all of it once, as Zhou et al. "
      "print it for the isotropic phase function; or none";
  return knob;
}

enum : std::uint32_t {
  voxels_id = FramePlan::first_own_id,
  volumes_id,
  surfaces_id,
  particles_id = surfaces_id + 2,
  lines_id,
  links_id,
  first_id,
  particle_sources_id,
  residuals_id,
  sources_id,
  sky_id,
  samples_id,
  splats_id = samples_id + sampled_airlight_ids
};

// Throws InputError where the steps would hand on more than 2 GiB, of which the CPU takes about three times as much in all; then
// every index fits 32 bits, too.
void refuse_size(int particles, std::size_t directions, std::size_t floats) {
  constexpr std::size_t most_floats = std::size_t{1} << 29U;
  if (floats > most_floats)
    throw InputError("setting particles: the network of " + std::to_string(particles) + " particles and " +
                     std::to_string(directions) + " directions would take " + std::to_string(floats >> 18U) +
                     " MiB, expected at most " + std::to_string(most_floats >> 18U));
}

bool splatted(const KnobValues& knobs) { return knobs.choice("image") == "splats"; }

// The steps before the view ray, and what RayMarch reads of them.
struct NetworkPlan {
  NetworkFrame lattice;
  Plan::Upload particles;
  NetworkIteration iteration;
  Buffer sources;             // absent where particles are splatted
  glm::dvec3 first{0, 0, 0};  // [m] in the world
  glm::dvec3 spacing{1, 1, 1};
};

NetworkPlan add_network(FramePlan& frame, Buffer voxels) {
  const Scene& scene = frame.scene;
  const KnobValues& knobs = frame.request.knobs;
  const Medium& medium = scene.medium;
  const int particles = static_cast<int>(knobs.number("particles"));
  const int lines = (static_cast<int>(knobs.number("directions")) + 1) / 2, window = window_of(particles);
  const int iterations = static_cast<int>(knobs.number("iterations"));
  const DirectionSet set = knobs.choice("direction_set") == "random" ? DirectionSet::random : DirectionSet::fibonacci;
  const MediumBox box = medium_box(scene, static_cast<int>(knobs.number("resolution")));
  const NetworkFrame lattice = network_frame(box);
  const auto unit = static_cast<float>(lattice.unit);
  const bool isotropic = medium.phase.kind == PhaseKind::isotropic;
  const std::vector<Plan::Upload> uploads = network_uploads(scene, box, particles, lines, window, particles_id, set);
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
  frame.plan.steps.push_back({network, "which particles light meets along each line, and what is between them"});

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
                      .first = {{first_id}, bytes(values)}};
  for (const std::size_t index : frame.light_index) light.lights.push_back(light_of(scene.lights[index], lattice.middle));
  frame.plan.steps.push_back({light, "what each particle scatters of the lights"});

  const NetworkIteration iteration{.particles = network.particles,
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
                                   .sources = {{particle_sources_id}, bytes(values)},
                                   .residuals = {{residuals_id}, sizeof(float) * (1 + static_cast<std::size_t>(iterations))}};
  frame.plan.steps.push_back({iteration, "light from particle to particle, an order of scattering a round"});

  NetworkPlan made;
  made.lattice = lattice, made.particles = uploads[0], made.iteration = iteration;
  if (splatted(knobs)) {
    frame.plan.skips.push_back({"source_function", "image = splats: the particles themselves are seen"});
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
  // Finer than all of the medium would be: what is left out beyond is as at the box's sides, and loses a hundredth of a beam at
  // most.
  const MediumBox inner = medium_box(scene, static_cast<int>(knobs.number("resolution")), 0.01);
  const glm::dvec3 corner = glm::floor((inner.corner - lattice.middle) / lattice.unit);
  source.first = corner;
  source.stride = static_cast<int>(std::ceil(inner.cell / lattice.unit));
  source.nodes = glm::vec3(inner.cells + 1);
  made.first = lattice.middle + corner * lattice.unit;
  made.spacing = glm::dvec3(source.stride * lattice.unit);
  source.sources = {{sources_id}, bytes(source.floats())};
  frame.plan.steps.push_back({source, "what there is to scatter toward the camera, everywhere"});
  made.sources = source.sources;
  return made;
}

Plan plan(const Scene& scene, const FrameRequest& request) {
  const Medium& medium = scene.medium;
  FramePlan frame(scene, request);
  const std::vector<GaussianDensity> gaussians = gaussians_of(scene);
  Buffer voxels;
  GridDensity grid;
  if (medium.grid) {
    frame.plan.uploads.push_back(voxels_of(*medium.grid, voxels_id));
    voxels = frame.plan.uploads.back().buffer;
    grid = grid_density(*medium.grid, scene.camera.position);
  }
  const Buffer volumes = frame.add_shadow_volumes(volumes_id);
  NetworkPlan network;
  const bool any = !gaussians.empty() || grid;
  if (any) network = add_network(frame, voxels);
  constexpr int light_steps = 16;
  const RayMarch march{.distance = frame.distance,
                       .voxels = voxels,
                       .volumes = volumes,
                       .depths = {},
                       .sources = network.sources,
                       .lights = frame.lights,
                       .depth_volumes = {},
                       .gaussians = gaussians,
                       .grid = grid,
                       .view = frame.view,
                       .phase = medium.phase,
                       .extinction = frame.extinction,
                       .sky_distance = frame.sky_distance,
                       .albedo = medium.albedo,
                       .ambient = frame.ambient,
                       .emission = medium.emission,
                       .steps = static_cast<int>(request.knobs.number("steps")),
                       .light_steps = medium.grid ? light_steps : 1,
                       .light_depth = LightDepth::analytic,
                       .source_first = glm::vec3(network.first - scene.camera.position),
                       .source_spacing = glm::vec3(network.spacing),
                       .airlight = frame.airlight,
                       .per_light = frame.per_light,
                       .transmittance = frame.transmittance,
                       .optical_depth = frame.optical_depth};
  if (any && splatted(request.knobs)) {
    add_particle_splats(frame, network.iteration, network.particles, network.lattice, march, splats_id);
  } else {
    frame.plan.steps.push_back({march, "light scattered once along the view ray, and that of the particles"});
    sample_airlight(frame, samples_id);
  }
  LightMarch way;
  way.voxels = voxels, way.gaussians = gaussians, way.grid = grid;
  way.light_steps = medium.grid ? light_steps : 1, way.light_depth = LightDepth::analytic;
  frame.shade_through(way, volumes, surfaces_id);

  // What this scene does not need, and what is not in the network.
  if (gaussians.size() < medium.gaussians.size())
    frame.plan.skips.push_back({"Gaussians of zero extinction", "they are not there"});
  if (!any) frame.plan.skips.push_back({"visibility_network", "nothing for particles to stand for"});
  if (frame.has_surfaces())
    frame.plan.skips.push_back(
        {"surfaces in the network", "light reaches particles through them, from lights and from particles"});
  return frame.finish();
}

// It has more light than the others, of orders that a goal's error is not about: no goal takes it.
Estimate estimate(const Scene& scene, Extent extent, const KnobValues& knobs, int threads) {
  const double pixels = static_cast<double>(extent.width) * extent.height;
  const auto gaussians = static_cast<double>(scene.medium.gaussians.size());
  const double ray = knobs.number("steps") * (10 + gaussians * (3 + 6 * static_cast<double>(scene.lights.size())));
  const double surfaces = surface_nanoseconds(scene, extent, knobs.choice("shadows") != "off");
  return {std::numeric_limits<double>::infinity(), 1e-9 * (pixels * ray + surfaces) / threads};
}

}  // namespace

Technique illumination_network() {
  Technique t;
  t.name = "illumination-network";
  t.summary = "multiple scattering in Gaussians and grids, among particles (Szirmay-Kalos et al. 2005)";
  t.knobs = {{.name = "particles",
              .kind = Knob::Kind::integer,
              .standard = "4096",
              .least = 1,
              .most = 100000,
              .choices = {},
              .meaning = "how many stand for the medium",
              .sweep = {}},
             {.name = "directions",
              .kind = Knob::Kind::integer,
              .standard = "256",
              .least = 1,
              .most = 1024,
              .choices = {},
              .meaning = "in which light goes from particle to particle, both ways of half as many lines (of an odd one more)",
              .sweep = {}},
             {.name = "direction_set",
              .kind = Knob::Kind::choice,
              .standard = "fibonacci",
              .least = 0,
              .most = 0,
              .choices = {"fibonacci", "random"},
              .meaning = "directions spread evenly over the sphere, or at random, always the same ones, as published; with each "
                         "its opposite",
              .sweep = {},
              .baselines = {"random"}},
             {.name = "iterations",
              .kind = Knob::Kind::integer,
              .standard = "1000",
              .least = 1,
              .most = 10000,
              .choices = {},
              .meaning = "rounds at most: each is an order of scattering",
              .sweep = {}},
             {.name = "tolerance",
              .kind = Knob::Kind::number,
              .standard = "0.001",
              .least = 0,
              .most = 1,
              .choices = {},
              .meaning = "rounds end where about that part of the light is left out, of orders of scattering that were not made",
              .sweep = {}},
             {.name = "resolution",
              .kind = Knob::Kind::integer,
              .standard = "32",
              .least = 2,
              .most = 256,
              .choices = {},
              .meaning = "cells of the source function along the longest edge of what matters of the medium",
              .sweep = {}},
             {.name = "steps",
              .kind = Knob::Kind::integer,
              .standard = "32",
              .least = 1,
              .most = 4096,
              .choices = {},
              .meaning = "steps along the view ray in each stretch of medium",
              .sweep = {}},
             {.name = "image",
              .kind = Knob::Kind::choice,
              .standard = "source",
              .least = 0,
              .most = 0,
              .choices = {"source", "splats"},
              .meaning = "what is seen: the particles' source function along the view ray, light scattered once exactly, or the "
                         "particles, sorted, splatted and blended, as published",
              .sweep = {},
              .baselines = {"splats"}},
             splat_radius_knob(),
             shadows_knob(),
             airlight_resolution_knob(),
             indirect_knob(),
             scattered_environment_knob(),
             environment_indirect_knob(),
             environment_shadows_knob(),
             environment_rays_knob()};
  t.multiple_scattering = true;
  t.refuses = refuses;
  t.plan = plan;
  t.estimate = estimate;
  return t;
}

}  // namespace airlight
