#include "common/techniques/shadow_planes.h"

#include <algorithm>

#include "common/plan/frame.h"
#include "common/techniques/estimates.h"

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
                                             .lights = of_unit_power(frame.lights),
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
  auto step = frame.along_view_ray<HomogeneousAirlight>();
  step.tables = scattered ? Buffer{} : tables;
  step.scattered = scattered;
  step.lights = scattered_lights;
  frame.plan.steps.push_back({step, "light scattered once along the view ray"});

  // What this scene does not need.
  if (scatters && !tables) frame.plan.skips.push_back({Rule::no_tables, "airlight tables", "no point light"});
  if (!scatters) frame.plan.skips.push_back({Rule::no_scattering, "airlight of the lights", "the medium scatters nothing"});
  return frame.finish();
}

}  // namespace

Technique shadow_planes() {
  Technique t;
  t.name = "shadow-planes";
  t.summary = "analytic single scattering and exact shadows in homogeneous fog (Biri et al. 2006)";
  t.knobs = {table_nodes_knob(),
             choice_knob("shadows", {"on", "published", "off"},
                         "shadows of the casters, in the medium and on surfaces; published: planes sorted as wholes, as the "
                         "paper does, wrong where they interleave",
                         {}, {"published"}),
             indirect_knob(),
             environment_knob(),
             environment_indirect_knob(),
             environment_shadows_knob(),
             environment_rays_knob()};
  t.refuses = refuses;
  t.plan = plan;
  t.estimate = estimate_shadow_planes;
  return t;
}

}  // namespace airlight
