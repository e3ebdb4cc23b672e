#include "common/techniques/gaussian_airlight.h"

#include <algorithm>
#include <string>

#include "common/plan/gaussian_bins.h"
#include "common/plan/gaussian_light_volumes.h"
#include "common/plan/gaussian_panels.h"
#include "common/plan/gaussian_shadows.h"
#include "common/plan/projected_gaussians.h"
#include "common/plan/ray_noise.h"
#include "common/plan/sampled_airlight.h"
#include "common/plan/surface_knobs.h"
#include "common/techniques/estimates.h"

namespace airlight {

namespace {

std::optional<std::string> refuses(const Scene& scene) {
  if (scene.medium.grid) return "it renders Gaussians and homogeneous fog, the scene has a grid";
  return std::nullopt;
}

enum : std::uint32_t {
  volumes_id = FramePlan::first_own_id,
  surfaces_id,
  injected_id = surfaces_id + 2,
  samples_id,
  projected_id = samples_id + sampled_airlight_ids,
  depths_id = projected_id + projected_gaussians_ids
};

Plan plan(const Scene& given, const FrameRequest& request) {
  FramePlan frame(given, request);
  const Scene& scene = frame.scene;
  const Medium& medium = scene.medium;
  const std::vector<GaussianDensity> gaussians = gaussians_of(scene, scene.camera.position, request.knobs.number("lost_depth"));

  // Held where no Gaussian is, so that it makes nothing stale.
  const Erf erf = !gaussians.empty() && request.knobs.choice("erf") == "fast" ? Erf::fast : Erf::accurate;

  // Section 5.5: rays are bent where they cross Gaussians; lights' are not.
  const RayNoise noise = ray_noise(scene);
  std::vector<GaussianDensity> met = gaussians;
  widen(met, noise);
  if (medium.noise.amplitude > 0 && !(noise.amplitude > 0)) frame.plan.skips.push_back({Rule::no_noise, "noise", "no Gaussians"});

  // Section 3: the homogeneous term has a closed form where nothing shades it.
  const bool lamps = std::any_of(frame.lights.begin(), frame.lights.end(), [](const Light& l) { return !l.directional; });
  Buffer tables;
  if (frame.extinction > 0 && lamps) tables = frame.add_airlight_tables();
  // Which parts of each ray the lights reach.
  const Buffer volumes = frame.add_shadow_volumes(volumes_id);
  const LightVolumes toward_lights = add_gaussian_light_volumes(frame, gaussians, injected_id, depths_id);
  if (!gaussians.empty() && request.knobs.choice("light_path") == "published") {
    add_projected_gaussians(frame, gaussians, erf, tables, volumes, projected_id, depths_id + 1);
  } else {
    auto step = frame.along_view_ray<GaussianAirlight>();
    step.tables = tables;
    step.volumes = volumes;
    step.depths = toward_lights.depths;
    step.depth_volumes = toward_lights.volumes;
    step.gaussians = met;
    step.samples = static_cast<int>(request.knobs.number("samples"));
    step.erf = erf;
    step.noise = noise;
    if (!met.empty() && !shines(step))
      frame.plan.skips.push_back({Rule::no_nodes, "nodes along the view rays", "nothing on them is lit or glows"});
    frame.plan.steps.push_back({step, "light scattered once along the view ray"});
    sample_airlight(frame, samples_id);  // section 5.4
  }
  // Section 4: surfaces are lit through the medium.
  LightMarch way;
  way.gaussians = gaussians, way.light_steps = 1, way.erf = erf;
  way.depths = toward_lights.depths, way.depth_volumes = toward_lights.volumes;
  way.light_depth = way.depths.empty() ? LightDepth::analytic : LightDepth::volume;
  frame.shade_through(way, volumes, surfaces_id);

  // What this scene does not need.
  const auto out_of_view =
      std::count_if(met.begin(), met.end(), [&](const GaussianDensity& g) { return !in_view(frame.view, g); });
  if (out_of_view > 0) {
    frame.plan.skips.push_back({Rule::out_of_view, "rays through " + std::to_string(out_of_view) + " Gaussians out of view",
                                toward_lights.depths.empty() ? "they may shade what is seen, and do nothing else"
                                                             : "they are in the volumes toward the lights, and nowhere else"});
  }
  if (!tables) frame.plan.skips.push_back({Rule::no_tables, "airlight tables", lamps ? "no homogeneous fog" : "no point light"});
  return frame.finish();
}

}  // namespace

Technique gaussian_airlight() {
  Technique t;
  t.name = "gaussian-airlight";
  t.summary = "analytic optical depths of Gaussians, single scattering by a few nodes each (Zhou et al. 2007)";
  t.knobs = with_surface_knobs(
      {integer_knob("samples", "4", 1, 16,
                    "nodes along the view ray in each panel, which is four radii of the smallest Gaussian there at most",
                    {"1", "2", "3", "4", "5", "6", "8", "12", "16"}),
       number_knob("lost_depth", "1e-4", least_lost_depth, 0.01,
                   "optical depth that a way may lose of each Gaussian, and the share of the Gaussian's own: what lies farther "
                   "out is left out",
                   {"1e-5", "1e-4", "1e-3"}),
       choice_knob(
           "erf", {"accurate", "fast"},
           "error function of the Gaussians' optical depths: to single precision, or the paper's printed polynomial, 2e-4 "
           "of a Gaussian's whole line away",
           {}, {"fast"}),
       choice_knob("light_path", {"auto", "exact", "volume", "published"},
                   "optical depths from each node to each light: closed forms, or looked up in a volume of each light's; auto: "
                   "volumes for more than 16 Gaussians, unless these are too small for 128 cells an edge; published: the paper's "
                   "airlight, one sample a Gaussian and the light's way by its centre, without shadows of surfaces",
                   {"exact", "volume"}, {"published"}),
       number_knob(
           "light_cells", "3", 0.5, 16,
           "cells of those volumes in the radius of the smallest Gaussian; up to two thirds more in volumes of 64 along an edge",
           {"1.5", "3", "6"}),
       table_nodes_knob()});
  t.refuses = refuses;
  t.plan = plan;
  t.estimate = estimate_gaussian_airlight;
  return t;
}

}  // namespace airlight
