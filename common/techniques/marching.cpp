#include "common/techniques/marching.h"

#include "common/plan/frame.h"
#include "common/plan/ray_noise.h"
#include "common/plan/sampled_airlight.h"
#include "common/plan/surface_knobs.h"
#include "common/plan/voxels.h"
#include "common/techniques/estimates.h"

namespace airlight {

namespace {

Plan plan(const Scene& given, const FrameRequest& request) {
  enum : std::uint32_t { voxels_id = FramePlan::first_own_id, volumes_id, surfaces_id, samples_id = surfaces_id + 2 };
  FramePlan frame(given, request);
  const Scene& scene = frame.scene;
  const Medium& medium = scene.medium;
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
  auto march = frame.along_view_ray<RayMarch>();
  march.voxels = voxels;
  march.volumes = volumes;
  march.gaussians = gaussians;
  march.grid = grid;
  march.steps = static_cast<int>(request.knobs.number("steps"));
  march.light_steps = light_steps;
  march.light_depth = light_depth;
  frame.plan.steps.push_back({march, "the view ray through the medium, step by step"});
  sample_airlight(frame, samples_id);
  LightMarch way;
  way.voxels = voxels, way.gaussians = gaussians, way.grid = grid;
  way.light_steps = light_steps, way.light_depth = light_depth;
  frame.shade_through(way, volumes, surfaces_id);

  // What this scene does not need.
  if (!uneven)
    frame.plan.skips.push_back(
        {Rule::homogeneous, "marching toward the lights", "the medium is homogeneous: light_steps and shadow do nothing"});
  return frame.finish();
}

}  // namespace

Technique marching() {
  Technique t;
  t.name = "marching";
  t.summary = "ray marching through any medium";
  t.knobs =
      with_surface_knobs({integer_knob("steps", "32", 1, 4096, "steps along the view ray in each stretch of medium",
                                       {"2", "4", "8", "16", "32", "64", "128", "256"}),
                          integer_knob("light_steps", "16", 1, 4096,
                                       "steps from each sample to each light, through grids and, with shadow=march, Gaussians",
                                       {"4", "8", "16", "32", "64"}),
                          choice_knob("shadow", {"analytic", "march"}, "how the light's way through Gaussians is attenuated",
                                      {"analytic", "march"})});
  t.refuses = refuses_noise;
  t.plan = plan;
  t.estimate = estimate_marching;
  return t;
}

}  // namespace airlight
