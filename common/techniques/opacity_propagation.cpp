#include "common/techniques/opacity_propagation.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/error.h"
#include "common/plan/light_volumes.h"
#include "common/plan/ray_noise.h"
#include "common/plan/sampled_airlight.h"
#include "common/plan/voxels.h"
#include "common/techniques/march_error.h"

namespace airlight {

namespace {

constexpr std::size_t few_gaussians = 4;  // that many are evaluated faster than a cell is looked up

// One grid has one albedo, and does not glow.
bool holds_in_a_grid(const Medium& medium) {
  const glm::dvec3* albedo = medium.grid ? &medium.grid->albedo : nullptr;
  for (const Gaussian& g : medium.gaussians) {
    if (!(g.extinction > 0)) continue;
    if (!albedo) albedo = &g.albedo;
    if (g.albedo != *albedo || g.emission != glm::dvec3(0)) return false;
  }
  return true;
}

glm::vec3 grid_albedo(const Medium& medium) { return medium.grid ? medium.grid->albedo : medium.gaussians.front().albedo; }

enum : std::uint32_t {
  volumes_id = FramePlan::first_own_id,
  surfaces_id,
  voxels_id = surfaces_id + 2,
  injected_id,
  samples_id,
  depths_id = samples_id + sampled_airlight_ids
};

// Both of a scene with Gaussians or a grid.
struct VolumePlan {
  FramePlan& frame;
  const Scene& scene;
  MediumBox box;
  bool cells;     // the volumes are those of the box's cells
  bool injected;  // rays are marched through them
  bool halves;    // and what they and the volumes hold is kept in 16 bits
  Buffer native;  // the scene's grid
  Buffer extinction;

  VolumePlan(FramePlan& f, const KnobValues& knobs) : frame(f), scene(f.scene) {
    const Medium& medium = scene.medium;
    box = medium_box(scene, static_cast<int>(knobs.number("resolution")));
    cells = knobs.choice("scheme") != "rays";
    halves = knobs.choice("storage") == "half";
    if (cells && halves) throw InputError("setting storage: \"half\" is for scheme=rays, expected float");
    const std::string_view density = knobs.choice("density");
    const bool can = holds_in_a_grid(medium);
    if (density == "volume" && !can)
      throw InputError(
          "setting density: \"volume\" has one albedo and no emission, the scene's Gaussians have more; expected auto or exact");
    injected = box && can && (density == "volume" || (density == "auto" && medium.gaussians.size() > few_gaussians));
    if (medium.grid) {
      frame.plan.uploads.push_back(voxels_of(*medium.grid, voxels_id));
      native = frame.plan.uploads.back().buffer;
    }
    if (box && (injected || (cells && !frame.lights.empty()))) {
      extinction = add_density_injection(frame, box, as_given(box.corner), half_unit(), injected_id);
    } else if (box) {
      frame.plan.skips.push_back(
          {"density_injection", medium.gaussians.size() <= few_gaussians
                                    ? "a grid as it is and a few Gaussians in closed form are faster"
                                    : "Gaussians of several albedos, that glow, or wanted in closed form"});
    }
  }

  Density as_given(const glm::dvec3& origin) const {
    Density d;
    d.gaussians = gaussians_of(scene, origin);
    if (scene.medium.grid) d.voxels = native, d.grid = grid_density(*scene.medium.grid, origin);
    return d;
  }
  // A power of 2: no extinction is above 2^14 of it, twice of which sharpened ones may have, and thin ones have all their digits.
  float half_unit() const {
    if (!halves) return 0;
    double most = 0;
    for (const Gaussian& g : scene.medium.gaussians) most += g.extinction;
    if (const auto& grid = scene.medium.grid; grid && !grid->voxels->values.empty())
      most += static_cast<double>(*std::max_element(grid->voxels->values.begin(), grid->voxels->values.end())) * grid->scale;
    return static_cast<float>(std::exp2(std::clamp(std::ceil(std::log2(std::max(most, 1e-30))) - 14, -100.0, 100.0)));
  }
  Density in_box(const glm::dvec3& origin) const {
    Density d{{}, extinction, box_density(box, grid_albedo(scene.medium), origin)};
    d.grid.half_unit = half_unit();
    return d;
  }
  Density to_march() const { return injected ? in_box(scene.camera.position) : as_given(scene.camera.position); }

  // How many lookups between two nodes of a light's ray the grid is worth.
  int samples(bool in_cells) const {
    double finest = box.cell;
    if (!in_cells && scene.medium.grid) {
      for (int axis = 0; axis < 3; ++axis) finest = std::min(finest, glm::length(glm::dvec3(scene.medium.grid->transform[axis])));
    }
    return std::clamp(static_cast<int>(std::ceil(1.5 * box.cell / finest)), 1, 8);
  }

  LightVolumes propagate(const KnobValues& knobs) {
    return add_light_volumes(frame, box,
                             {.from = cells || injected ? in_box(box.corner) : as_given(box.corner),
                              .cells = cells,
                              .scheme = knobs.choice("scheme") == "published" ? DepthScheme::published : DepthScheme::upwind,
                              .samples = samples(cells || injected),
                              .halves = halves,
                              .floats = extinction.bytes / sizeof(float)},
                             depths_id);
  }
};

Plan plan(const Scene& scene, const FrameRequest& request) {
  const Medium& medium = scene.medium;
  FramePlan frame(scene, request);
  const Buffer volumes = frame.add_shadow_volumes(volumes_id);
  VolumePlan volume(frame, request.knobs);
  LightVolumes toward_lights;
  const Density density = volume.to_march();
  if (volume.box && !frame.lights.empty()) {
    toward_lights = volume.propagate(request.knobs);
  } else {
    frame.plan.skips.push_back({"optical_depth_propagation", volume.box ? "no light" : "the medium is homogeneous"});
  }
  const LightDepth light_depth = toward_lights.depths.empty() ? LightDepth::analytic : LightDepth::volume;
  frame.plan.steps.push_back({RayMarch{.distance = frame.distance,
                                       .voxels = density.voxels,
                                       .volumes = volumes,
                                       .depths = toward_lights.depths,
                                       .sources = {},
                                       .lights = frame.lights,
                                       .depth_volumes = toward_lights.volumes,
                                       .gaussians = density.gaussians,
                                       .grid = density.grid,
                                       .view = frame.view,
                                       .phase = medium.phase,
                                       .extinction = frame.extinction,
                                       .sky_distance = frame.sky_distance,
                                       .albedo = medium.albedo,
                                       .ambient = frame.ambient,
                                       .emission = medium.emission,
                                       .steps = static_cast<int>(request.knobs.number("steps")),
                                       .light_steps = 1,
                                       .light_depth = light_depth,
                                       .airlight = frame.airlight,
                                       .per_light = frame.per_light,
                                       .transmittance = frame.transmittance,
                                       .optical_depth = frame.optical_depth},
                              "the view ray through the medium, step by step"});
  sample_airlight(frame, samples_id);
  LightMarch way;
  way.voxels = density.voxels, way.gaussians = density.gaussians, way.grid = density.grid;
  way.depths = toward_lights.depths, way.depth_volumes = toward_lights.volumes, way.light_steps = 1,
  way.light_depth = light_depth;
  frame.shade_through(way, volumes, surfaces_id);
  return frame.finish();
}

// Error: left_by_steps(), and look-ups between the nodes of the volumes; baselines have what no model tells. Time: thread
// nanoseconds a pixel of which half meet the medium, and the volumes, as if they were always made anew.
Estimate estimate(const Scene& scene, Extent extent, const KnobValues& knobs, int threads) {
  const double steps = knobs.number("steps"), resolution = knobs.number("resolution");
  const double lights = static_cast<double>(scene.lights.size());
  const MediumBox box = medium_box(scene, static_cast<int>(resolution));
  double error = left_by_steps(scene, steps), nanoseconds = 4 * lights, volumes = 0;
  if (box) {
    error += gaussians_part(scene).left_by_cells(box.cell) + grid_part(scene).left_by_cells(box.cell);
    nanoseconds += 0.5 * steps * (6 + 8 * lights);
    volumes = 8 * lights * std::pow(resolution, 3);
  }
  if (scene.medium.extinction > 0) nanoseconds += steps * (2 + 10 * lights);
  if (knobs.choice("scheme") != "rays" || knobs.choice("airlight_resolution") != "full") error = HUGE_VAL;
  const double surfaces = surface_nanoseconds(scene, extent, knobs.choice("shadows") != "off");
  return {error, 1e-9 * (nanoseconds * extent.width * extent.height + volumes + surfaces) / threads};
}

}  // namespace

Technique opacity_propagation() {
  Technique t;
  t.name = "opacity-propagation";
  t.summary = "any medium, each light's optical depths carried through a volume (Giroud and Biri)";
  t.knobs = {
      {.name = "resolution",
       .kind = Knob::Kind::integer,
       .standard = "64",
       .least = 2,
       .most = 256,
       .choices = {},
       .meaning = "cells along the longest edge of the box about Gaussians and grid",
       .sweep = {"12", "16", "24", "32", "48", "64", "96", "128"}},
      {.name = "steps",
       .kind = Knob::Kind::integer,
       .standard = "64",
       .least = 1,
       .most = 4096,
       .choices = {},
       .meaning = "steps along the view ray in each stretch of medium",
       .sweep = {"8", "16", "32", "64", "128"}},
      {.name = "scheme",
       .kind = Knob::Kind::choice,
       .standard = "rays",
       .choices = {"rays", "upwind", "published"},
       .meaning = "how depths are carried: along the light's rays; from cell to cell, consistently or as the paper prints it",
       .sweep = {},
       .baselines = {"upwind", "published"}},
      {.name = "density",
       .kind = Knob::Kind::choice,
       .standard = "auto",
       .choices = {"auto", "exact", "volume"},
       .meaning = "extinction along the rays: each Gaussian and the grid as it is, or all from one volume of that resolution",
       .sweep = {},
       .baselines = {"exact"}},
      {.name = "storage",
       .kind = Knob::Kind::choice,
       .standard = "float",
       .choices = {"float", "half"},
       .meaning = "what volumes are kept in: 32 bits a value, or 16",
       .sweep = {}},
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
