#include "common/techniques/marching.h"

#include <algorithm>
#include <cmath>

#include "common/plan/frame.h"
#include "common/plan/ray_noise.h"
#include "common/plan/sampled_airlight.h"
#include "common/plan/voxels.h"
#include "common/techniques/march_error.h"

namespace airlight {

namespace {

Plan plan(const Scene& scene, const FrameRequest& request) {
  enum : std::uint32_t { voxels_id = FramePlan::first_own_id, volumes_id, surfaces_id, samples_id = surfaces_id + 2 };
  const Medium& medium = scene.medium;
  FramePlan frame(scene, request);
  const std::vector<GaussianDensity> gaussians = gaussians_of(scene);
  const bool uneven = !gaussians.empty() || medium.grid;
  // Knobs that this scene does not need are held, so that they make nothing stale.
  const bool marched = request.knobs.choice("shadow") == "march" && !gaussians.empty();
  const LightDepth light_depth = marched ? LightDepth::march : LightDepth::analytic;
  const int light_steps = marched || medium.grid ? static_cast<int>(request.knobs.number("light_steps")) : 1;

  Buffer voxels;
  GridDensity grid;
  if (medium.grid) {
    frame.plan.uploads.push_back(voxels_of(*medium.grid, voxels_id));
    voxels = frame.plan.uploads.back().buffer;
    grid = grid_density(*medium.grid, scene.camera.position);
  }
  const Buffer volumes = frame.add_shadow_volumes(volumes_id);
  frame.plan.steps.push_back({RayMarch{.distance = frame.distance,
                                       .voxels = voxels,
                                       .volumes = volumes,
                                       .depths = {},
                                       .sources = {},
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
                                       .light_steps = light_steps,
                                       .light_depth = light_depth,
                                       .airlight = frame.airlight,
                                       .per_light = frame.per_light,
                                       .transmittance = frame.transmittance,
                                       .optical_depth = frame.optical_depth},
                              "the view ray through the medium, step by step"});
  sample_airlight(frame, samples_id);
  LightMarch way;
  way.voxels = voxels, way.gaussians = gaussians, way.grid = grid;
  way.light_steps = light_steps, way.light_depth = light_depth;
  frame.shade_through(way, volumes, surfaces_id);

  // What this scene does not need.
  if (gaussians.size() < medium.gaussians.size())
    frame.plan.skips.push_back({"Gaussians of zero extinction", "they are not there"});
  if (!uneven)
    frame.plan.skips.push_back({"marching toward the lights", "the medium is homogeneous: light_steps and shadow do nothing"});
  return frame.finish();
}

// Error: left_by_steps() along the view rays and, where they are marched, on the ways to the lights. Time: thread nanoseconds a
// pixel, by counting look-ups, lights and steps; half of the pixels are taken to meet Gaussians or grid.
Estimate estimate(const Scene& scene, Extent extent, const KnobValues& knobs, int threads) {
  const Medium& medium = scene.medium;
  const double n = knobs.number("steps"), light_n = knobs.number("light_steps");
  const bool marched = knobs.choice("shadow") == "march";
  const double lights = static_cast<double>(scene.lights.size()), count = static_cast<double>(medium.gaussians.size());
  const UnevenPart gaussians = gaussians_part(scene), grid = grid_part(scene);
  double error = left_by_steps(scene, n), nanoseconds = 4 * lights;
  if (marched) error += gaussians.left_by(light_n);
  if (medium.grid) error += grid.left_by(light_n);
  // What samples do not tell is not modelled.
  if (knobs.choice("airlight_resolution") != "full") error = HUGE_VAL;
  if (medium.extinction > 0) nanoseconds += n * (2 + 10 * lights) * (medium.gaussians.empty() && !medium.grid ? 1 : 2);
  if (gaussians.length > 0) nanoseconds += 0.5 * n * (10 + 10 * lights + count * (3 + lights * (marched ? 4 * light_n : 6)));
  if (medium.grid) nanoseconds += 0.5 * n * (10 + lights * (10 + 7 * light_n));
  const double surfaces = surface_nanoseconds(scene, extent, knobs.choice("shadows") != "off");
  return {error, 1e-9 * (nanoseconds * extent.width * extent.height + surfaces) / threads};
}

}  // namespace

Technique marching() {
  Technique t;
  t.name = "marching";
  t.summary = "ray marching through any medium";
  t.knobs = {{.name = "steps",
              .kind = Knob::Kind::integer,
              .standard = "32",
              .least = 1,
              .most = 4096,
              .choices = {},
              .meaning = "steps along the view ray in each stretch of medium",
              .sweep = {"2", "4", "8", "16", "32", "64", "128", "256"}},
             {.name = "light_steps",
              .kind = Knob::Kind::integer,
              .standard = "16",
              .least = 1,
              .most = 4096,
              .choices = {},
              .meaning = "steps from each sample to each light, through grids and, with shadow=march, Gaussians",
              .sweep = {"4", "8", "16", "32", "64"}},
             {.name = "shadow",
              .kind = Knob::Kind::choice,
              .standard = "analytic",
              .choices = {"analytic", "march"},
              .meaning = "how the light's way through Gaussians is attenuated",
              .sweep = {"analytic", "march"}},
             shadows_knob(),
             airlight_resolution_knob(),
             indirect_knob(),
             environment_knob(),
             environment_indirect_knob(),
             environment_shadows_knob(),
             environment_rays_knob()};
  t.refuses = [](const Scene& scene) {
    const auto why = refuses_noise(scene);
    return why ? why : refuses_environment(scene);
  };
  t.plan = plan;
  t.estimate = estimate;
  return t;
}

}  // namespace airlight
