#include "common/techniques/shadow_planes.h"

#include <algorithm>
#include <limits>

#include "common/plan/airlight_tables.h"
#include "common/plan/geometry.h"
#include "common/plan/hash.h"
#include "common/plan/images.h"
#include "common/plan/indirect.h"
#include "common/plan/shadow_volumes.h"

namespace airlight {

namespace {

std::optional<std::string> refuses(const Scene& scene) {
  if (!scene.medium.gaussians.empty()) return "it renders homogeneous media only, the scene has Gaussians";
  if (scene.medium.grid) return "it renders homogeneous media only, the scene has a grid";
  return std::nullopt;
}

// Whether anything throws a shadow that can be seen; in `plan` what is left out.
bool any_shadow(const Scene& scene, const std::vector<std::size_t>& lights, bool wanted, Plan& plan) {
  bool any = false;
  const bool casters = std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                                   [](const Surface& s) { return s.casts_shadow && !s.mesh->triangles.empty(); });
  if (!casters || lights.empty()) {
    plan.skips.push_back({"shadow planes", casters ? "no light" : "nothing casts a shadow"});
  } else if (!wanted) {
    plan.skips.push_back({"shadow planes", "shadows = off"});
  } else {
    std::size_t out_of_reach = 0;
    for (const std::size_t light : lights) {
      for (const Surface& s : scene.surfaces) {
        if (!s.casts_shadow || s.mesh->triangles.empty()) continue;
        if (shadow_matters(scene, s, scene.lights[light])) {
          any = true;
        } else {
          ++out_of_reach;
        }
      }
    }
    if (out_of_reach > 0) {
      plan.skips.push_back({"silhouettes of " + std::to_string(out_of_reach) + " casters out of reach of a light",
                            "the fog before them lets nothing through"});
    }
    if (!any) plan.skips.push_back({"shadow planes", "no light reaches a caster"});
  }
  return any;
}

Plan plan(const Scene& scene, const FrameRequest& request) {
  enum : std::uint32_t {
    geometry_id = 1,
    tables_id = 4,
    per_light_id = 5,
    volumes_id = 6,
    scattered_id = 7,
    lit_id = 8,
    indirect_tables_id = 9,
    first_image_id = 10
  };
  Plan plan;
  const Medium& medium = scene.medium;
  const View view = view_of(scene, request);
  std::vector<std::size_t> light_index;
  const std::vector<Light> lights = lights_of(scene, &light_index);
  const auto extinction = static_cast<float>(medium.extinction);
  const auto sky = static_cast<float>(std::min(scene.sky_distance, 1e30));
  const bool foggy = extinction > 0;
  const glm::vec3 ambient = foggy ? glm::vec3(medium.ambient) : glm::vec3(0);

  Images images(request, plan, first_image_id);
  const Image distance = images.make("depth", Format::r32f);
  const Image normal = images.make("normal", Format::rgb32f);
  const Image material = images.make("material", Format::r32f);
  const Image transmittance = images.make("transmittance", Format::r32f);
  const Image optical_depth = images.optional("optical_depth", Format::r32f);
  const Image surface = images.make("surface", Format::rgb32f);
  const Image direct = images.optional("surface.direct", Format::rgb32f);
  const Image surface_ambient = images.optional("surface.ambient", Format::rgb32f);
  const Image airlight = images.make("airlight", Format::rgb32f);
  const Image beauty = images.make("beauty", Format::rgb32f);
  const Image per_light = per_light_images(scene, request, light_index, per_light_id, plan);

  // Section 2 of the paper: what each pixel sees, and through how much medium.
  const Geometry geometry = geometry_of(scene, geometry_id);
  plan.uploads.push_back(geometry.positions);
  plan.uploads.push_back(geometry.normals);
  plan.uploads.push_back(geometry.indices);
  plan.steps.push_back({SurfaceVisibility{.positions = geometry.positions.buffer,
                                          .normals = geometry.normals.buffer,
                                          .triangles = geometry.indices.buffer,
                                          .view = view,
                                          .distance = distance,
                                          .normal = normal,
                                          .material = material},
                        "what each pixel sees"});

  // Section 4: which parts of each ray the lights reach. Shadow planes start at the casters' silhouettes.
  const bool scatters = foggy && medium.albedo != glm::dvec3(0);
  const std::vector<Light> scattered_lights = scatters || per_light ? lights : std::vector<Light>{};
  Buffer tables;
  if (foggy && std::any_of(scattered_lights.begin(), scattered_lights.end(), [](const Light& l) { return !l.directional; })) {
    tables = {{tables_id}, 0};
    const int nodes = static_cast<int>(request.knobs.number("table_nodes"));
    Hash key;
    key.add(medium.phase);
    key.add(nodes);
    plan.uploads.push_back({tables, key.value(), [phase = medium.phase, nodes] {
                              const std::vector<float> values = airlight_tables(phase, nodes);
                              const auto bytes = std::as_bytes(std::span(values));
                              return std::vector<std::byte>(bytes.begin(), bytes.end());
                            }});
  }
  Image scattered, lit;
  if (any_shadow(scene, light_index, request.knobs.choice("shadows") != "off", plan)) {
    const ShadowOrder order = request.knobs.choice("shadows") == "published" ? ShadowOrder::published : ShadowOrder::exact;
    const int layers = static_cast<int>(lights.size());
    if (!scattered_lights.empty() && foggy) scattered = {{scattered_id}, Format::r32f, request.extent, layers, false};
    if (!scene.surfaces.empty()) lit = {{lit_id}, Format::r32f, request.extent, layers, false};
    Plan::Upload volumes =
        shadow_volumes_upload(scene, light_index, order, geometry.positions.key ^ geometry.indices.key, volumes_id);
    plan.uploads.push_back(volumes);
    plan.steps.push_back({ShadowPlanes{.distance = distance,
                                       .volumes = volumes.buffer,
                                       .tables = scattered ? tables : Buffer{},
                                       .lights = lights,
                                       .view = view,
                                       .phase = medium.phase,
                                       .order = order,
                                       .extinction = extinction,
                                       .sky_distance = sky,
                                       .scattered = scattered,
                                       .light_transmittance = lit},
                          order == ShadowOrder::exact ? "which parts of each ray the lights reach"
                                                      : "which parts of each ray the lights reach, by planes sorted as wholes"});
  }
  plan.steps.push_back({ViewTransmittance{.distance = distance,
                                          .extinction = extinction,
                                          .sky_distance = sky,
                                          .transmittance = transmittance,
                                          .optical_depth = optical_depth},
                        "how much of it comes through the fog"});
  // Section 3-C: light scattered once on its way to the surfaces.
  SurfaceAirlight given;
  given.distance = distance, given.normal = normal, given.material = material, given.transmittance = transmittance;
  given.lights = lights, given.view = view;
  const Image indirect = add_indirect(scene, request, given, indirect_tables_id, images, plan);
  plan.steps.push_back({SurfaceShading{.distance = distance,
                                       .normal = normal,
                                       .material = material,
                                       .transmittance = transmittance,
                                       .light_transmittance = lit,
                                       .indirect = indirect,
                                       .materials = materials_of(scene),
                                       .lights = lights,
                                       .view = view,
                                       .extinction = extinction,
                                       .ambient = ambient,
                                       .background = scene.background,
                                       .surface = surface,
                                       .surface_direct = direct,
                                       .surface_ambient = surface_ambient},
                        "direct light on the surfaces, attenuated on both ways"});

  // Section 3: light scattered once on its way along the view ray.
  plan.steps.push_back({HomogeneousAirlight{.distance = distance,
                                            .tables = scattered ? Buffer{} : tables,
                                            .scattered = scattered,
                                            .lights = scattered_lights,
                                            .view = view,
                                            .phase = medium.phase,
                                            .extinction = extinction,
                                            .sky_distance = sky,
                                            .albedo = medium.albedo,
                                            .ambient = ambient,
                                            .emission = medium.emission,
                                            .airlight = airlight,
                                            .per_light = per_light},
                        "light scattered once along the view ray"});
  plan.steps.push_back({Compose{.surface = surface, .airlight = airlight, .beauty = beauty}, "surface + airlight"});

  // What this scene does not need.
  if (lights.size() < scene.lights.size()) plan.skips.push_back({"lights of zero power", "they light nothing"});
  if (scatters && !tables) plan.skips.push_back({"airlight tables", "no point light"});
  if (!scatters) plan.skips.push_back({"airlight of the lights", "the medium scatters nothing"});
  return plan;
}

// Fitted to the sweeps of docs/RESULTS.md. The error is that of single precision and, growing with the third power of their
// coarseness, of the tables; pixels at edges are not counted. Time: thread nanoseconds a pixel, a triangle, and a pixel and
// light.
Estimate estimate(const Scene& scene, Extent extent, const KnobValues& knobs, int threads) {
  const double coarseness = 64 / knobs.number("table_nodes"), lights = static_cast<double>(scene.lights.size());
  double triangles = 0, casting = 0;
  for (const Surface& s : scene.surfaces) {
    const auto count = static_cast<double>(s.mesh->triangles.size());
    triangles += count;
    if (s.casts_shadow) casting += count;
  }
  const double pixels = static_cast<double>(extent.width) * extent.height;
  const double nanoseconds = pixels * (12 + lights * (casting > 0 ? 60 : 20)) + triangles * 100 + casting * lights * 150;
  const double seconds = 1e-9 * nanoseconds / threads;
  // How far planes interleave is not known without rendering them.
  if (casting > 0 && knobs.choice("shadows") == "published") return {std::numeric_limits<double>::infinity(), seconds};
  return {1e-4 + 5e-5 * coarseness * coarseness * coarseness, seconds};
}

}  // namespace

Technique shadow_planes() {
  Technique t;
  t.name = "shadow-planes";
  t.summary = "analytic single scattering and exact shadows in homogeneous fog (Biri et al. 2006)";
  t.knobs = {
      {.name = "table_nodes",
       .kind = Knob::Kind::integer,
       .standard = "64",
       .least = 16,
       .most = 128,
       .choices = {},
       .meaning =
           "nodes an axis of the airlight tables (up to 4 times as many for a peaked phase): accuracy against time to make them",
       .sweep = {"16", "24", "32", "48", "64", "96", "128"}},
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
      indirect_knob()};
  t.refuses = refuses;
  t.plan = plan;
  t.estimate = estimate;
  return t;
}

}  // namespace airlight
