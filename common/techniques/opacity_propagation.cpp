#include "common/techniques/opacity_propagation.h"

#include "common/plan/medium_volumes.h"
#include "common/plan/ray_noise.h"
#include "common/plan/sampled_airlight.h"
#include "common/plan/surface_knobs.h"
#include "common/techniques/estimates.h"

namespace airlight {

namespace {

enum : std::uint32_t {
  volumes_id = FramePlan::first_own_id,
  surfaces_id,
  medium_id = surfaces_id + 2,
  samples_id = medium_id + 2,
  depths_id = samples_id + sampled_airlight_ids
};

Plan plan(const Scene& scene, const FrameRequest& request) {
  FramePlan frame(scene, request);
  const Buffer volumes = frame.add_shadow_volumes(volumes_id);
  const MediumVolumes medium(frame, medium_id);                    // 4.2: the medium on a grid
  const LightVolumes toward_lights = medium.propagate(depths_id);  // 4.3: optical depths, from the lights on
  const Density density = medium.to_march();
  const LightDepth light_depth = toward_lights.depths.empty() ? LightDepth::analytic : LightDepth::volume;
  // 4.4: the medium is marched through, surfaces are lit through it.
  auto march = frame.along_view_ray<RayMarch>();
  march.voxels = density.voxels;
  march.volumes = volumes;
  march.depths = toward_lights.depths;
  march.depth_volumes = toward_lights.volumes;
  march.gaussians = density.gaussians;
  march.grid = density.grid;
  march.steps = static_cast<int>(request.knobs.number("steps"));
  march.light_steps = 1;
  march.light_depth = light_depth;
  frame.plan.steps.push_back({march, "the view ray through the medium, step by step"});
  sample_airlight(frame, samples_id);
  LightMarch way;
  way.voxels = density.voxels, way.gaussians = density.gaussians, way.grid = density.grid;
  way.depths = toward_lights.depths, way.depth_volumes = toward_lights.volumes, way.light_steps = 1,
  way.light_depth = light_depth;
  frame.shade_through(way, volumes, surfaces_id);
  return frame.finish();
}

}  // namespace

Technique opacity_propagation() {
  Technique t;
  t.name = "opacity-propagation";
  t.summary = "any medium, each light's optical depths carried through a volume (Giroud and Biri)";
  t.knobs = with_surface_knobs(
      {integer_knob("resolution", "64", 2, 256, "cells along the longest edge of the box about Gaussians and grid",
                    {"12", "16", "24", "32", "48", "64", "96", "128"}),
       integer_knob("steps", "64", 1, 4096, "steps along the view ray in each stretch of medium", {"8", "16", "32", "64", "128"}),
       choice_knob("scheme", {"rays", "upwind", "published"},
                   "how depths are carried: along the light's rays; from cell to cell, consistently or as the paper prints it",
                   {}, {"upwind", "published"}),
       choice_knob(
           "density", {"auto", "exact", "volume"},
           "extinction along the rays: each Gaussian and the grid as it is, or all from one volume of that resolution; auto: "
           "as it is with up to 4 Gaussians, else a volume, of twice that resolution where Gaussians are small",
           {}, {"exact"}),
       choice_knob("storage", {"float", "half"}, "what volumes are kept in: 32 bits a value, or 16")});
  t.refuses = refuses_noise;
  t.plan = plan;
  t.estimate = estimate_opacity_propagation;
  return t;
}

}  // namespace airlight
