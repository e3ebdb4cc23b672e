#include "common/techniques/shadow_planes.h"

#include <algorithm>

#include "common/plan/airlight_tables.h"
#include "common/plan/geometry.h"
#include "common/plan/hash.h"
#include "common/plan/images.h"

namespace airlight {

namespace {

std::optional<std::string> refuses(const Scene& scene) {
  if (!scene.medium.gaussians.empty()) return "it renders homogeneous media only, the scene has Gaussians";
  if (scene.medium.grid) return "it renders homogeneous media only, the scene has a grid";
  return std::nullopt;
}

Plan plan(const Scene& scene, const FrameRequest& request) {
  enum : std::uint32_t { geometry_id = 1, tables_id = 4, per_light_id = 5, first_image_id = 6 };
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
  plan.steps.push_back({ViewTransmittance{.distance = distance,
                                          .extinction = extinction,
                                          .sky_distance = sky,
                                          .transmittance = transmittance,
                                          .optical_depth = optical_depth},
                        "how much of it comes through the fog"});
  plan.steps.push_back({SurfaceShading{.distance = distance,
                                       .normal = normal,
                                       .material = material,
                                       .transmittance = transmittance,
                                       .light_transmittance = {},
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
  const bool scatters = foggy && medium.albedo != glm::dvec3(0);
  const std::vector<Light> scattered = scatters || per_light ? lights : std::vector<Light>{};
  Buffer tables;
  if (foggy && std::any_of(scattered.begin(), scattered.end(), [](const Light& l) { return !l.directional; })) {
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
  plan.steps.push_back({HomogeneousAirlight{.distance = distance,
                                            .tables = tables,
                                            .lights = scattered,
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
  const bool casters = std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [](const Surface& s) { return s.casts_shadow; });
  if (casters) plan.skips.push_back({"shadows", "casters are ignored: this version has no shadow planes"});
  return plan;
}

}  // namespace

Technique shadow_planes() {
  Technique t;
  t.name = "shadow-planes";
  t.summary = "analytic single scattering in homogeneous fog (Biri et al. 2006)";
  t.knobs = {
      {.name = "table_nodes",
       .kind = Knob::Kind::integer,
       .standard = "64",
       .least = 16,
       .most = 128,
       .choices = {},
       .meaning =
           "nodes an axis of the airlight tables (up to 4 times as many for a peaked phase): accuracy against time to make them",
       .sweep = {"16", "24", "32", "48", "64", "96", "128"}}};
  t.refuses = refuses;
  t.plan = plan;
  return t;
}

}  // namespace airlight
