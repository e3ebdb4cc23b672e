#include "common/techniques/illumination_network.h"

#include <string>

#include "common/plan/network_steps.h"
#include "common/plan/particle_splats.h"
#include "common/plan/ray_noise.h"
#include "common/plan/sampled_airlight.h"
#include "common/plan/surface_knobs.h"
#include "common/plan/voxels.h"
#include "common/techniques/estimates.h"

namespace airlight {

namespace {

std::optional<std::string> refuses(const Scene& scene) {
  if (scene.medium.gaussians.empty() && !scene.medium.grid)
    return "its particles stand for Gaussians and grids, the scene has neither";
  return refuses_noise(scene);
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
  network_id = surfaces_id + 2,
  samples_id = network_id + network_ids,
  splats_id = samples_id + sampled_airlight_ids
};

bool splatted(const KnobValues& knobs) { return knobs.choice("image") == "splats"; }

Plan plan(const Scene& given, const FrameRequest& request) {
  FramePlan frame(given, request);
  const Scene& scene = frame.scene;
  const Medium& medium = scene.medium;
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
  if (any) network = add_network(frame, voxels, splatted(request.knobs), network_id);
  constexpr int light_steps = 16;
  auto march = frame.along_view_ray<RayMarch>();
  march.voxels = voxels;
  march.volumes = volumes;
  march.sources = network.sources;
  march.gaussians = gaussians;
  march.grid = grid;
  march.steps = static_cast<int>(request.knobs.number("steps"));
  march.light_steps = medium.grid ? light_steps : 1;
  march.light_depth = LightDepth::analytic;
  march.source_first = glm::vec3(network.first - scene.camera.position);
  march.source_spacing = glm::vec3(network.spacing);
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
  if (!any) frame.plan.skips.push_back({Rule::no_network, "visibility_network", "nothing for particles to stand for"});
  if (frame.has_surfaces())
    frame.plan.skips.push_back({Rule::unhindered_network, "surfaces in the network",
                                "light reaches particles through them, from lights and from particles"});
  return frame.finish();
}

}  // namespace

Technique illumination_network() {
  Technique t;
  t.name = "illumination-network";
  t.summary = "multiple scattering in Gaussians and grids, among particles (Szirmay-Kalos et al. 2005)";
  t.knobs = with_surface_knobs(
      {integer_knob("particles", "4096", 1, most_particles, "of particle_set=sampled: how many stand for the medium"),
       choice_knob("particle_set", {"sampled", "gaussians"},
                   "places sampled in proportion to the extinction, or each Gaussian of a medium without a grid one particle"),
       integer_knob("directions", "256", 1, 1024,
                    "in which light goes from particle to particle, both ways of half as many lines (of an odd one more)"),
       choice_knob(
           "direction_set", {"fibonacci", "random"},
           "directions spread evenly over the sphere, or at random, always the same ones, as published; with each its opposite",
           {}, {"random"}),
       integer_knob("iterations", "1000", 1, 10000, "rounds at most: each is an order of scattering, or as much work"),
       number_knob("tolerance", "0.001", 0, 1,
                   "rounds end where about that part of the light is left out, of orders of scattering that were not made"),
       choice_knob("acceleration", {"on", "off"},
                   "rounds of conjugate gradients, far fewer, where the phase function is isotropic; off, rounds are orders of "
                   "scattering everywhere"),
       integer_knob("resolution", "32", 2, 256,
                    "cells of the source function along the longest edge of what matters of the medium; more of them where it is "
                    "narrower"),
       integer_knob("steps", "32", 1, 4096, "steps along the view ray in each stretch of medium"),
       choice_knob("image", {"source", "splats"},
                   "what is seen: the particles' source function along the view ray, light scattered once exactly, or the "
                   "particles, sorted, splatted and blended, as published",
                   {}, {"splats"}),
       splat_radius_knob()},
      scattered_environment_knob());
  t.multiple_scattering = true;
  t.refuses = refuses;
  t.plan = plan;
  t.estimate = estimate_illumination_network;
  return t;
}

}  // namespace airlight
