#include "common/techniques/gaussian_airlight.h"

#include <algorithm>
#include <cmath>

#include "common/plan/frame.h"
#include "common/plan/ray_noise.h"
#include "common/plan/sampled_airlight.h"

namespace airlight {

namespace {

std::optional<std::string> refuses(const Scene& scene) {
  if (scene.medium.grid) return "it renders Gaussians and homogeneous fog, the scene has a grid";
  return std::nullopt;
}

Plan plan(const Scene& scene, const FrameRequest& request) {
  enum : std::uint32_t { volumes_id = FramePlan::first_own_id, surfaces_id, samples_id = surfaces_id + 2 };
  const Medium& medium = scene.medium;
  FramePlan frame(scene, request);
  const std::vector<GaussianDensity> gaussians = gaussians_of(scene);

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
  frame.plan.steps.push_back({GaussianAirlight{.distance = frame.distance,
                                               .tables = tables,
                                               .volumes = volumes,
                                               .lights = frame.lights,
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
  // Section 4: surfaces are lit through the medium.
  LightMarch way;
  way.gaussians = gaussians, way.light_steps = 1, way.light_depth = LightDepth::analytic, way.erf = erf;
  frame.shade_through(way, volumes, surfaces_id);

  // What this scene does not need.
  if (gaussians.size() < medium.gaussians.size())
    frame.plan.skips.push_back({"Gaussians of zero extinction", "they are not there"});
  if (!tables) frame.plan.skips.push_back({"airlight tables", lamps ? "no homogeneous fog" : "no point light"});
  return frame.finish();
}

// The error of n nodes, fitted to tests/truth/gaussian_airlight.cpp on the safe side: it falls by 3.7 from one to the next, down
// to that of single precision. Time: thread nanoseconds a pixel; of many Gaussians a ray meets few.
Estimate estimate(const Scene& scene, Extent extent, const KnobValues& knobs, int threads) {
  const double n = knobs.number("samples"), lights = static_cast<double>(scene.lights.size());
  const double gaussians = static_cast<double>(gaussians_of(scene).size());
  const double coarseness = 64 / knobs.number("table_nodes");
  double error = 1e-4;
  if (gaussians > 0) error += 4 * std::exp(-1.3 * n);
  if (gaussians > 0 && knobs.choice("erf") == "fast") error += 6e-4;
  // What samples do not tell is not modelled, and of noise there is no truth.
  if (knobs.choice("airlight_resolution") != "full" || ray_noise(scene).amplitude > 0) error = HUGE_VAL;
  if (scene.medium.extinction > 0) error += 5e-5 * coarseness * coarseness * coarseness;
  const double met = std::pow(gaussians, 0.75);
  const double pixels = static_cast<double>(extent.width) * extent.height;
  const double nanoseconds =
      surface_nanoseconds(scene, extent, knobs.choice("shadows") != "off") + pixels * (25 * lights + n * met * (8 + 10 * lights));
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
      table_nodes_knob(),
      shadows_knob(),
      airlight_resolution_knob(),
      indirect_knob()};
  t.refuses = refuses;
  t.plan = plan;
  t.estimate = estimate;
  return t;
}

}  // namespace airlight
