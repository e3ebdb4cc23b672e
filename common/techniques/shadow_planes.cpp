#include "common/techniques/shadow_planes.h"

#include <algorithm>
#include <limits>

#include "common/plan/frame.h"

namespace airlight {

namespace {

std::optional<std::string> refuses(const Scene& scene) {
  if (!scene.medium.gaussians.empty()) return "it renders homogeneous media only, the scene has Gaussians";
  if (scene.medium.grid) return "it renders homogeneous media only, the scene has a grid";
  return std::nullopt;
}

Plan plan(const Scene& scene, const FrameRequest& request) {
  enum : std::uint32_t { volumes_id = FramePlan::first_own_id, scattered_id, lit_id };
  const Medium& medium = scene.medium;
  // Section 2 of the paper: what each pixel sees, and through how much medium.
  FramePlan frame(scene, request);
  const bool foggy = frame.extinction > 0;

  // Section 4: which parts of each ray the lights reach. Shadow planes start at the casters' silhouettes.
  const bool scatters = foggy && medium.albedo != glm::dvec3(0);
  const std::vector<Light> scattered_lights = scatters || frame.per_light ? frame.lights : std::vector<Light>{};
  Buffer tables;
  if (foggy && std::any_of(scattered_lights.begin(), scattered_lights.end(), [](const Light& l) { return !l.directional; })) {
    tables = frame.add_airlight_tables();
  }
  Image scattered, lit;
  const ShadowOrder order = request.knobs.choice("shadows") == "published" ? ShadowOrder::published : ShadowOrder::exact;
  if (const Buffer volumes = frame.add_shadow_volumes(volumes_id, order)) {
    const int layers = static_cast<int>(frame.lights.size());
    if (!scattered_lights.empty() && foggy) scattered = frame.handed_on(scattered_id, Format::r32f, layers);
    if (frame.has_surfaces()) lit = frame.handed_on(lit_id, Format::r32f, layers);
    frame.plan.steps.push_back({ShadowPlanes{.distance = frame.distance,
                                             .volumes = volumes,
                                             .tables = scattered ? tables : Buffer{},
                                             .lights = frame.lights,
                                             .view = frame.view,
                                             .phase = medium.phase,
                                             .order = order,
                                             .extinction = frame.extinction,
                                             .sky_distance = frame.sky_distance,
                                             .scattered = scattered,
                                             .light_transmittance = lit},
                                order == ShadowOrder::exact
                                    ? "which parts of each ray the lights reach"
                                    : "which parts of each ray the lights reach, by planes sorted as wholes"});
  }
  frame.plan.steps.push_back({ViewTransmittance{.distance = frame.distance,
                                                .extinction = frame.extinction,
                                                .sky_distance = frame.sky_distance,
                                                .transmittance = frame.transmittance,
                                                .optical_depth = frame.optical_depth},
                              "how much of it comes through the fog"});
  frame.shade(lit);  // section 3-C among it: light scattered once on its way to the surfaces

  // Section 3: light scattered once on its way along the view ray.
  frame.plan.steps.push_back({HomogeneousAirlight{.distance = frame.distance,
                                                  .tables = scattered ? Buffer{} : tables,
                                                  .scattered = scattered,
                                                  .lights = scattered_lights,
                                                  .view = frame.view,
                                                  .phase = medium.phase,
                                                  .extinction = frame.extinction,
                                                  .sky_distance = frame.sky_distance,
                                                  .albedo = medium.albedo,
                                                  .ambient = frame.ambient,
                                                  .emission = medium.emission,
                                                  .airlight = frame.airlight,
                                                  .per_light = frame.per_light},
                              "light scattered once along the view ray"});

  // What this scene does not need.
  if (scatters && !tables) frame.plan.skips.push_back({"airlight tables", "no point light"});
  if (!scatters) frame.plan.skips.push_back({"airlight of the lights", "the medium scatters nothing"});
  return frame.finish();
}

// Fitted to the sweeps of docs/RESULTS.md. The error is that of single precision and, growing with the third power of their
// coarseness, of the tables; pixels at edges are not counted. Time: thread nanoseconds a pixel, a triangle, and a pixel and
// light.
Estimate estimate(const Scene& scene, Extent extent, const KnobValues& knobs, int threads) {
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

}  // namespace

Technique shadow_planes() {
  Technique t;
  t.name = "shadow-planes";
  t.summary = "analytic single scattering and exact shadows in homogeneous fog (Biri et al. 2006)";
  t.knobs = {
      table_nodes_knob(),
      {.name = "shadows",
       .kind = Knob::Kind::choice,
       .standard = "on",
       .least = 0,
       .most = 0,
       .choices = {"on", "published", "off"},
       .meaning = "shadows of the casters, in the medium and on surfaces; published: planes sorted as wholes, as the paper does, "
                  "wrong where they interleave",
       .sweep = {},
       .baselines = {"published"}},
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
