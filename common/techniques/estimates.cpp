#include "common/techniques/estimates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/plan/depth_volumes.h"
#include "common/plan/gaussian_light_volumes.h"
#include "common/plan/projected_gaussians.h"
#include "common/plan/ray_noise.h"
#include "common/techniques/march_error.h"

namespace airlight {

namespace {

// Thread nanoseconds that surfaces and shadows take, whatever the technique makes of the rays between.
double surface_nanoseconds(const Scene& scene, Extent extent, bool shadows) {
  double triangles = 0, casting = 0;
  for (const Surface& s : scene.surfaces) {
    const auto count = static_cast<double>(s.mesh->triangles.size());
    triangles += count;
    if (s.casts_shadow && shadows) casting += count;
  }
  const double pixels = static_cast<double>(extent.width) * extent.height, lights = static_cast<double>(scene.lights.size());
  return pixels * (12 + (casting > 0 ? 40 * lights : 0)) + triangles * 100 + casting * lights * 150;
}

}  // namespace

// Fitted to the sweeps of docs/RESULTS.md. The error is that of single precision and, growing with the third power of their
// coarseness, of the tables; pixels at edges are not counted. Time: thread nanoseconds a pixel, a triangle, and a pixel and
// light.
Estimate estimate_shadow_planes(const Scene& scene, Extent extent, const KnobValues& knobs, int threads) {
  const double coarseness = 64 / knobs.number("table_nodes"), lights = static_cast<double>(scene.lights.size());
  const bool casters = std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                                   [](const Surface& one) { return one.casts_shadow && !one.mesh->triangles.empty(); });
  const double pixels = static_cast<double>(extent.width) * extent.height;
  const double nanoseconds = surface_nanoseconds(scene, extent, knobs.choice("shadows") != "off") + pixels * lights * 20;
  const double seconds = 1e-9 * nanoseconds / threads;
  // How far planes interleave is not known without rendering them.
  if (casters && knobs.choice("shadows") == "published") return {std::numeric_limits<double>::infinity(), seconds};
  return {1e-4 + 5e-5 * coarseness * coarseness * coarseness, seconds};
}

// Error: left_by_steps() along the view rays and, where they are marched, on the ways to the lights. Time: thread nanoseconds a
// pixel, by counting look-ups, lights and steps; half of the pixels are taken to meet Gaussians or grid.
Estimate estimate_marching(const Scene& scene, Extent extent, const KnobValues& knobs, int threads) {
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

// The error of n nodes, fitted to tests/truth/gaussian_airlight.cpp on the safe side: it falls by 3.7 from one to the next, down
// to that of single precision; that of volumes; and what lies out of reach. Time: thread nanoseconds a pixel; of many Gaussians a
// ray meets few.
Estimate estimate_gaussian_airlight(const Scene& scene, Extent extent, const KnobValues& knobs, int threads) {
  const double n = knobs.number("samples"), lights = static_cast<double>(scene.lights.size());
  const double gaussians = static_cast<double>(gaussians_of(scene).size());
  const double coarseness = 64 / knobs.number("table_nodes"), cells = knobs.number("light_cells");
  const std::string_view path = knobs.choice("light_path");
  const bool volumes = gaussians > 0 && (path == "volume" || (path == "auto" && gaussians > static_cast<double>(few_gaussians)));
  const double lost = knobs.number("lost_depth");
  double error = 1e-4;
  if (gaussians > 0 && path == "published") error = HUGE_VAL;  // a baseline
  if (gaussians > 0) error += 4 * (std::exp(-1.3 * n) + lost);
  // The printed error function is 2e-4 of a Gaussian's whole line away.
  double deepest = 1;
  for (const Gaussian& g : scene.medium.gaussians) deepest = std::max(deepest, g.extinction * g.radius);
  if (gaussians > 0 && knobs.choice("erf") == "fast") error += 6e-4 * deepest;
  if (volumes) error += 0.11 / (cells * cells);
  // What samples do not tell is not modelled, and of noise there is no truth.
  if (knobs.choice("airlight_resolution") != "full" || ray_noise(scene).amplitude > 0) error = HUGE_VAL;
  if (scene.medium.extinction > 0) error += 5e-5 * coarseness * coarseness * coarseness;
  const double met = std::pow(gaussians, 0.75) * std::log(1 / lost) / std::log(1 / least_lost_depth);
  const double pixels = static_cast<double>(extent.width) * extent.height;
  const double of_a_ray = lights == 0 ? met : volumes ? 1.3 * n * met + 150 * lights : n * met * (3 + 4 * lights);
  double nanoseconds = surface_nanoseconds(scene, extent, knobs.choice("shadows") != "off") + pixels * (25 * lights + of_a_ray);
  if (volumes) nanoseconds += 5e6 * lights * std::pow(cells / 3, 3);
  return {error, 1e-9 * nanoseconds / threads};
}

// Error: left_by_steps(), and look-ups between the nodes of the volumes; baselines have what no model tells. Time: thread
// nanoseconds a pixel of which half meet the medium, and the volumes, as if they were always made anew.
Estimate estimate_opacity_propagation(const Scene& scene, Extent extent, const KnobValues& knobs, int threads) {
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

// It has more light than the others, of orders that a goal's error is not about: no goal takes it.
Estimate estimate_illumination_network(const Scene& scene, Extent extent, const KnobValues& knobs, int threads) {
  const double pixels = static_cast<double>(extent.width) * extent.height;
  const auto gaussians = static_cast<double>(scene.medium.gaussians.size());
  const double ray = knobs.number("steps") * (10 + gaussians * (3 + 6 * static_cast<double>(scene.lights.size())));
  const double surfaces = surface_nanoseconds(scene, extent, knobs.choice("shadows") != "off");
  return {std::numeric_limits<double>::infinity(), 1e-9 * (pixels * ray + surfaces) / threads};
}

}  // namespace airlight
