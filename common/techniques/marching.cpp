#include "common/techniques/marching.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "common/plan/frame.h"
#include "common/plan/ray_noise.h"
#include "common/plan/sampled_airlight.h"
#include "common/plan/voxels.h"

namespace airlight {

namespace {

constexpr double grid_scale = 6;  // cells over which the extinction of a grid is taken to change, in estimate()

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

// The farthest that a view ray goes [m]; infinite where one may hit nothing.
double longest_view(const Scene& scene) {
  double farthest = scene.sky_distance;
  if (std::isfinite(farthest)) {
    for (const Surface& s : scene.surfaces) {
      for (const glm::vec3& p : s.mesh->positions) {
        const glm::dvec3 place(s.transform * glm::dvec4(glm::dvec3(p), 1.0));
        farthest = std::max(farthest, glm::distance(place, scene.camera.position));
      }
    }
  }
  return farthest;
}

double farthest_lamp(const Scene& scene) {
  double distance = 0;
  for (const LightSource& l : scene.lights) {
    if (l.type == LightType::point) distance = std::max(distance, glm::distance(l.position, scene.camera.position));
  }
  return distance;
}

// Relative error left by n steps over a length in which the extinction changes over `scale`: the midpoint rule, and what it
// misses altogether where a step is longer than that.
double of_uneven(double length, double scale, double n) {
  const double y = length / (n * scale);
  return 0.02 * y * y * (1 + y * y / 5);
}

// The model's numbers are fitted to the sweeps of docs/RESULTS.md, by a factor of up to ten on the safe side: how steps lie to
// lamps decides.
// * homogeneous: 0.25 x^2, x the largest optical depth of a step before the farthest lamp (graded_step()),
// * an anisotropic phase function near a lamp: 0.4 / steps, its covariance with the fade in the one step that holds the lamp,
// * Gaussians and grid: of_uneven(), over the way through them; so too for marched ways to the light.
// Time: thread nanoseconds a pixel, by counting look-ups, lights and steps; half of the pixels are taken to meet Gaussians or
// grid.
Estimate estimate(const Scene& scene, Extent extent, const KnobValues& knobs, int threads) {
  const Medium& medium = scene.medium;
  const double n = knobs.number("steps"), light_n = knobs.number("light_steps");
  const bool marched = knobs.choice("shadow") == "march";
  const bool lamps =
      std::any_of(scene.lights.begin(), scene.lights.end(), [](const LightSource& l) { return l.type == LightType::point; });
  const double lights = static_cast<double>(scene.lights.size());
  const double view = longest_view(scene), lamp = std::min(farthest_lamp(scene), view);
  // What samples do not tell is not modelled.
  double error = knobs.choice("airlight_resolution") == "full" ? 3e-5 : HUGE_VAL, nanoseconds = 4 * lights;
  const bool isotropic = medium.phase.kind == PhaseKind::isotropic || medium.phase.kind == PhaseKind::rayleigh;
  if (!isotropic && lamps && !medium.empty()) error += 0.4 / n;
  if (medium.extinction > 0) {
    const double tau = std::min(medium.extinction * view, 80.0);
    const double x = (1 + medium.extinction * lamp) * std::log1p(tau) / n;
    error += 0.25 * x * x;
    nanoseconds += n * (2 + 10 * lights) * (medium.gaussians.empty() && !medium.grid ? 1 : 2);
  }
  double near_end = view, far_end = 0, least = 1e30;
  const auto count = static_cast<double>(medium.gaussians.size());
  for (const GaussianDensity& g : gaussians_of(scene)) {
    const double distance = static_cast<double>(glm::length(g.center)), reach = static_cast<double>(g.reach);
    near_end = std::min(near_end, std::max(distance - reach, 0.0));
    far_end = std::max(far_end, distance + reach);
    least = std::min(least, static_cast<double>(g.radius));
  }
  if (far_end > near_end) {
    const double length = std::min(far_end, view) - near_end;
    error += of_uneven(length, least, n);
    if (marched) error += of_uneven(length, least, light_n);
    nanoseconds += 0.5 * n * (10 + 10 * lights + count * (3 + lights * (marched ? 4 * light_n : 6)));
  }
  if (medium.grid) {
    const glm::dvec3 size(medium.grid->voxels->size);
    const glm::dmat3 frame(medium.grid->transform);
    const double cell = std::min({glm::length(frame[0]), glm::length(frame[1]), glm::length(frame[2])});
    const double diagonal = glm::length(frame * size);
    error += of_uneven(diagonal, grid_scale * cell, n) + of_uneven(diagonal, grid_scale * cell, light_n);
    nanoseconds += 0.5 * n * (10 + lights * (10 + 7 * light_n));
  }
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
             indirect_knob()};
  t.refuses = refuses_noise;
  t.plan = plan;
  t.estimate = estimate;
  return t;
}

}  // namespace airlight
