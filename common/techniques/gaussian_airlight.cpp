#include "common/techniques/gaussian_airlight.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/error.h"
#include "common/plan/gaussian_bins.h"
#include "common/plan/gaussian_shadows.h"
#include "common/plan/light_volumes.h"
#include "common/plan/projected_gaussians.h"
#include "common/plan/ray_noise.h"
#include "common/plan/sampled_airlight.h"

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
  depths_id = samples_id + sampled_airlight_ids
};

constexpr std::size_t few_gaussians = 16;  // that many stand in a light's way faster than a volume of their depths is made
constexpr double most_cells = 128;         // along an edge of a volume that nobody asked for
constexpr int finest_cells = 512;

// Cells along the longest edge of the box about the Gaussians, so many in the radius of the smallest that matters.
double cells_for(const Scene& scene, const std::vector<GaussianDensity>& gaussians, double cells_a_radius) {
  double radius = 1e300;
  for (const GaussianDensity& g : gaussians) radius = std::min(radius, smooth_radius(g));
  const double edge = 2 * medium_box(scene, 2).cell;
  return std::ceil(cells_a_radius * edge / radius);
}

// The depths toward the lights in volumes, where that is asked for or worth it.
LightVolumes light_volumes(FramePlan& frame, const std::vector<GaussianDensity>& gaussians) {
  const std::string_view path = frame.request.knobs.choice("light_path");
  const auto skip = [&](const char* why) {
    frame.plan.skips.push_back({"optical_depth_propagation", why});
    return LightVolumes{};
  };
  if (gaussians.empty() || frame.lights.empty()) return skip(gaussians.empty() ? "no Gaussian" : "no light");
  if (path == "exact") return skip("closed forms are wanted");
  if (path == "published" && !frame.has_surfaces()) return skip("only surfaces have their light from volumes");
  const double cells = cells_for(frame.scene, gaussians, frame.request.knobs.number("light_cells"));
  const bool if_worth_it = path != "volume";
  if (if_worth_it && gaussians.size() <= few_gaussians) return skip("closed forms of few Gaussians are faster");
  if (if_worth_it && cells > most_cells) return skip("the smallest Gaussian is small beside them all: closed forms");
  if (cells > finest_cells)
    throw InputError("setting light_cells: the volume would have " +
                     std::to_string(static_cast<long long>(std::min(cells, 1e15))) + " cells along an edge, expected at most " +
                     std::to_string(finest_cells));
  const MediumBox box = medium_box(frame.scene, std::max(static_cast<int>(cells), 2));
  Density density{gaussians_of(frame.scene, box.corner), {}, {}};
  // A ray through many is looked up on a grid of the same cells.
  if (gaussians.size() > few_gaussians) {
    const Buffer extinction = add_density_injection(frame, box, density, 0, injected_id);
    density = {{}, extinction, box_density(box, glm::vec3(1), box.corner)};
  }
  return add_light_volumes(
      frame, box,
      {.from = density, .cells = false, .samples = 2, .floats = density.voxels.bytes / sizeof(float), .knob = "light_cells"},
      depths_id);
}

Plan plan(const Scene& scene, const FrameRequest& request) {
  const Medium& medium = scene.medium;
  FramePlan frame(scene, request);
  const std::vector<GaussianDensity> gaussians = gaussians_of(scene, scene.camera.position, request.knobs.number("lost_depth"));

  // Held where no Gaussian is, so that it makes nothing stale.
  const Erf erf = !gaussians.empty() && request.knobs.choice("erf") == "fast" ? Erf::fast : Erf::accurate;

  // Section 5.5: rays are bent where they cross Gaussians; lights' are not.
  const RayNoise noise = ray_noise(scene);
  std::vector<GaussianDensity> met = gaussians;
  widen(met, noise);
  if (medium.noise.amplitude > 0 && !(noise.amplitude > 0)) frame.plan.skips.push_back({"noise", "no Gaussians"});

  // Section 3: the homogeneous term has a closed form where nothing shades it.
  const bool lamps = std::any_of(frame.lights.begin(), frame.lights.end(), [](const Light& l) { return !l.directional; });
  Buffer tables;
  if (frame.extinction > 0 && lamps) tables = frame.add_airlight_tables();
  // Which parts of each ray the lights reach.
  const Buffer volumes = frame.add_shadow_volumes(volumes_id);
  const LightVolumes toward_lights = light_volumes(frame, gaussians);
  if (!gaussians.empty() && request.knobs.choice("light_path") == "published") {
    const auto lights = static_cast<std::uint32_t>(frame.lights.size());
    add_projected_gaussians(frame, gaussians, erf, tables, volumes, depths_id + lights);
  } else {
    frame.plan.steps.push_back({GaussianAirlight{.distance = frame.distance,
                                                 .tables = tables,
                                                 .volumes = volumes,
                                                 .depths = toward_lights.depths,
                                                 .lights = frame.lights,
                                                 .depth_volumes = toward_lights.volumes,
                                                 .gaussians = met,
                                                 .view = frame.view,
                                                 .phase = medium.phase,
                                                 .extinction = frame.extinction,
                                                 .sky_distance = frame.sky_distance,
                                                 .albedo = medium.albedo,
                                                 .ambient = frame.ambient,
                                                 .emission = medium.emission,
                                                 .samples = static_cast<int>(request.knobs.number("samples")),
                                                 .erf = erf,
                                                 .noise = noise,
                                                 .airlight = frame.airlight,
                                                 .per_light = frame.per_light,
                                                 .transmittance = frame.transmittance,
                                                 .optical_depth = frame.optical_depth},
                                "light scattered once along the view ray"});
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
    frame.plan.skips.push_back({"rays through " + std::to_string(out_of_view) + " Gaussians out of view",
                                toward_lights.depths.empty() ? "they may shade what is seen, and do nothing else"
                                                             : "they are in the volumes toward the lights, and nowhere else"});
  }
  if (gaussians.size() < medium.gaussians.size())
    frame.plan.skips.push_back({"Gaussians of zero extinction", "they are not there"});
  if (!tables) frame.plan.skips.push_back({"airlight tables", lamps ? "no homogeneous fog" : "no point light"});
  return frame.finish();
}

// The error of n nodes, fitted to tests/truth/gaussian_airlight.cpp on the safe side: it falls by 3.7 from one to the next, down
// to that of single precision; that of volumes; and what lies out of reach. Time: thread nanoseconds a pixel; of many Gaussians a
// ray meets few.
Estimate estimate(const Scene& scene, Extent extent, const KnobValues& knobs, int threads) {
  const double n = knobs.number("samples"), lights = static_cast<double>(scene.lights.size());
  const double gaussians = static_cast<double>(gaussians_of(scene).size());
  const double coarseness = 64 / knobs.number("table_nodes"), cells = knobs.number("light_cells");
  const std::string_view path = knobs.choice("light_path");
  const bool volumes = gaussians > 0 && (path == "volume" || (path == "auto" && gaussians > static_cast<double>(few_gaussians)));
  const double lost = knobs.number("lost_depth");
  double error = 1e-4;
  if (gaussians > 0 && path == "published") error = HUGE_VAL;  // a baseline
  if (gaussians > 0) error += 4 * (std::exp(-1.3 * n) + lost);
  if (gaussians > 0 && knobs.choice("erf") == "fast") error += 6e-4;
  if (volumes) error += 0.11 / (cells * cells);
  // What samples do not tell is not modelled, and of noise there is no truth.
  if (knobs.choice("airlight_resolution") != "full" || ray_noise(scene).amplitude > 0) error = HUGE_VAL;
  if (scene.medium.extinction > 0) error += 5e-5 * coarseness * coarseness * coarseness;
  const double met = std::pow(gaussians, 0.75) * std::log(1 / lost) / std::log(1 / least_lost_depth);
  const double pixels = static_cast<double>(extent.width) * extent.height;
  const double of_a_ray = volumes ? 1.3 * n * met + 150 * lights : n * met * (3 + 4 * lights);
  double nanoseconds = surface_nanoseconds(scene, extent, knobs.choice("shadows") != "off") + pixels * (25 * lights + of_a_ray);
  if (volumes) nanoseconds += 5e6 * lights * std::pow(cells / 3, 3);
  return {error, 1e-9 * nanoseconds / threads};
}

}  // namespace

Technique gaussian_airlight() {
  Technique t;
  t.name = "gaussian-airlight";
  t.summary = "analytic optical depths of Gaussians, single scattering by a few nodes each (Zhou et al. 2007)";
  t.knobs = {
      {.name = "samples",
       .kind = Knob::Kind::integer,
       .standard = "4",
       .least = 1,
       .most = 16,
       .choices = {},
       .meaning = "nodes along the view ray in each panel, which is four radii of the smallest Gaussian there at most",
       .sweep = {"1", "2", "3", "4", "5", "6", "8", "12", "16"}},
      {.name = "lost_depth",
       .kind = Knob::Kind::number,
       .standard = "1e-4",
       .least = least_lost_depth,
       .most = 0.01,
       .choices = {},
       .meaning =
           "optical depth that a way may lose of each Gaussian, and the share of the Gaussian's own: what lies farther out "
           "is left out",
       .sweep = {"1e-5", "1e-4", "1e-3"}},
      {.name = "erf",
       .kind = Knob::Kind::choice,
       .standard = "accurate",
       .least = 0,
       .most = 0,
       .choices = {"accurate", "fast"},
       .meaning = "error function of the Gaussians' optical depths: to single precision, or the paper's printed polynomial, "
                  "2e-4 of a Gaussian's whole line away",
       .sweep = {},
       .baselines = {"fast"}},
      {.name = "light_path",
       .kind = Knob::Kind::choice,
       .standard = "auto",
       .least = 0,
       .most = 0,
       .choices = {"auto", "exact", "volume", "published"},
       .meaning = "optical depths from each node to each light: closed forms, or looked up in a volume of each light's; auto: "
                  "volumes for more than 16 Gaussians, unless these are too small for 128 cells an edge; published: the paper's "
                  "airlight, one sample a Gaussian and the light's way by its centre, without shadows of surfaces",
       .sweep = {"exact", "volume"},
       .baselines = {"published"}},
      {.name = "light_cells",
       .kind = Knob::Kind::number,
       .standard = "3",
       .least = 0.5,
       .most = 16,
       .choices = {},
       .meaning = "cells of those volumes in the radius of the smallest Gaussian",
       .sweep = {"1.5", "3", "6"}},
      table_nodes_knob(),
      shadows_knob(),
      airlight_resolution_knob(),
      indirect_knob(),
      environment_knob(),
      environment_indirect_knob(),
      environment_shadows_knob(),
      environment_rays_knob()};
  t.refuses = refuses;
  t.plan = plan;
  t.estimate = estimate;
  return t;
}

}  // namespace airlight
