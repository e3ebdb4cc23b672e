#include "common/plan/frame.h"

#include <algorithm>
#include <string>
#include <utility>

#include "common/error.h"
#include "common/plan/airlight_tables.h"
#include "common/plan/frame_ids.h"
#include "common/plan/hash.h"
#include "common/plan/image_names.h"
#include "common/plan/shadow_volumes.h"
#include "common/plan/surface_airlight_tables.h"
#include "common/plan/surface_psf.h"
#include "common/plan/upload.h"

namespace airlight {

Knob indirect_knob() {
  return choice_knob(
      "indirect", {"unbounded", "off", "mean_density", "psf"},
      "light of lamps and suns scattered once on its way to surfaces, as of an unbounded medium without shadows: of the "
      "homogeneous part; of the whole medium as if it were as dense everywhere as between light and surface, by the same tables "
      "or by the point spread function of Zhou et al. for the isotropic phase function");
}

Knob table_nodes_knob() {
  return integer_knob(
      "table_nodes", "64", 16, 128,
      "nodes an axis of the airlight tables (up to 4 times as many for a peaked phase): accuracy against time to make them",
      {"16", "24", "32", "48", "64", "96", "128"});
}

Knob shadows_knob() { return choice_knob("shadows", {"on", "off"}, "shadows of the casters, in the medium and on surfaces"); }

FramePlan::FramePlan(const Scene& given, const FrameRequest& r)
    : lean_(lean_scene(given)),
      scene(*lean_.scene),
      request(r),
      view(view_of(scene, r)),
      lights(lights_of(scene, &light_index)),
      extinction(static_cast<float>(scene.medium.extinction)),
      sky_distance(static_cast<float>(std::min(scene.sky_distance, 1e30))),
      ambient(scene.medium.empty() ? glm::dvec3(0) : scene.medium.ambient),
      geometry(geometry_of(scene, geometry_id)),
      brdfs(brdfs_of(scene)),
      next_id_(first_image_id) {
  distance = image("depth", Format::r32f);
  normal = image("normal", Format::rgb32f);
  material = image("material", Format::r32f);
  transmittance = image("transmittance", Format::r32f);
  optical_depth = optional_image("optical_depth", Format::r32f);
  surface_ = image("surface", Format::rgb32f);
  surface_direct_ = optional_image("surface.direct", Format::rgb32f);
  surface_ambient_ = optional_image("surface.ambient", Format::rgb32f);
  airlight = image("airlight", Format::rgb32f);
  beauty_ = image("beauty", Format::rgb32f);
  per_light = per_light_image();
  expect_environment_airlight();
  expect_environment_shadows();
  for (const Plan::Upload* upload : {&geometry.positions, &geometry.normals, &geometry.indices}) plan.uploads.push_back(*upload);
  plan.steps.push_back({SurfaceVisibility{.positions = geometry.positions.buffer,
                                          .normals = geometry.normals.buffer,
                                          .triangles = geometry.indices.buffer,
                                          .view = view,
                                          .distance = distance,
                                          .normal = normal,
                                          .material = material,
                                          .corners = corners_},
                        "what each pixel sees"});
  add_skips_of_the_scene();
}

void FramePlan::add_skips_of_the_scene() {
  const auto count = [](const auto& all, auto&& is) { return std::to_string(std::count_if(all.begin(), all.end(), is)); };
  const auto dark = [](const LightSource& l) { return l.power == glm::dvec3(0); };
  if (std::any_of(scene.lights.begin(), scene.lights.end(), dark))
    plan.skips.push_back({Rule::dark_lights, "lights of zero power", "they light nothing"});
  const auto far_away = [&](const LightSource& l) { return !dark(l) && out_of_reach(scene, l); };
  if (std::any_of(scene.lights.begin(), scene.lights.end(), far_away))
    plan.skips.push_back({Rule::lamps_out_of_reach, count(scene.lights, far_away) + " lamps out of reach",
                          "the fog before them lets nothing through"});
  if (lean_.empty > 0)
    plan.skips.push_back(
        {Rule::empty_gaussians, std::to_string(lean_.empty) + " Gaussians of zero extinction", "they are not there"});
  if (lean_.coincident > 0)
    plan.skips.push_back({Rule::coincident_gaussians, std::to_string(lean_.coincident) + " Gaussians",
                          "they lie on others of the same radius, and are added to them"});
  const auto hidden = [&](const Surface& s) { return behind_fog(scene, s); };
  if (std::any_of(scene.surfaces.begin(), scene.surfaces.end(), hidden))
    plan.skips.push_back({Rule::behind_fog, "light on " + count(scene.surfaces, hidden) + " surfaces",
                          "the fog before them lets nothing through"});
}

bool FramePlan::wanted(std::string_view name) const { return request.images.contains(std::string(name)); }

Image FramePlan::image(std::string_view name, Format format) {
  Image made{{next_id_++}, format, request.extent, 1, wanted(name)};
  if (made.keep) plan.outputs.push_back({std::string(name), made, 0});
  return made;
}

Image FramePlan::optional_image(std::string_view name, Format format) {
  if (wanted(name)) return image(name, format);
  ++next_id_;
  return {};
}

// One image with a layer a light, where any of them is wanted; else absent.
Image FramePlan::per_light_image() {
  const Image made{{per_light_id}, Format::rgb32f, request.extent, std::max(1, static_cast<int>(lights.size())), true};
  bool any = false;
  for (std::size_t layer = 0; layer < lights.size(); ++layer) {
    const std::string name = light_image_name(scene, light_index[layer]);
    if (!wanted(name)) continue;
    plan.outputs.push_back({name, made, static_cast<int>(layer)});
    any = true;
  }
  return any ? made : Image{};
}

Buffer FramePlan::add_airlight_tables() {
  const int nodes = static_cast<int>(request.knobs.number("table_nodes"));
  const Buffer tables{{airlight_tables_id}, sizeof(float) * airlight_table_floats(scene.medium.phase, nodes)};
  Hash key;
  key.add(scene.medium.phase);
  key.add(nodes);
  plan.uploads.push_back(
      table_upload(tables, key.value(), [phase = scene.medium.phase, nodes] { return airlight_tables(phase, nodes); }));
  return tables;
}

Buffer FramePlan::add_shadow_volumes(std::uint32_t id, ShadowOrder order) {
  const bool casters = std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                                   [](const Surface& s) { return s.casts_shadow && !s.mesh->triangles.empty(); });
  if (!casters || lights.empty()) {
    plan.skips.push_back({Rule::no_shadows, "shadow planes", casters ? "no light" : "nothing casts a shadow"});
    return {};
  }
  if (request.knobs.choice("shadows") == "off") {
    plan.skips.push_back({Rule::no_shadows, "shadow planes", "shadows = off"});
    return {};
  }
  bool any = false;
  std::size_t out_of_reach = 0;
  for (const std::size_t light : light_index) {
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
    plan.skips.push_back({Rule::casters_out_of_reach,
                          "silhouettes of " + std::to_string(out_of_reach) + " casters out of reach of a light",
                          "the fog before them lets nothing through"});
  }
  if (!any) {
    plan.skips.push_back({Rule::no_shadows, "shadow planes", "no light reaches a caster"});
    return {};
  }
  plan.uploads.push_back(shadow_volumes_upload(scene, light_index, order, geometry.positions.key ^ geometry.indices.key, id));
  return plan.uploads.back().buffer;
}

// Which surfaces the lights reach, where there are volumes: a layer a light; else absent.
Image FramePlan::add_lit(Buffer volumes, std::uint32_t id) {
  if (!volumes) return {};
  const Image lit = handed_on(id, Format::r32f, static_cast<int>(lights.size()));
  plan.steps.push_back({ShadowPlanes{.distance = distance,
                                     .volumes = volumes,
                                     .tables = {},
                                     .lights = of_unit_power(lights),
                                     .view = view,
                                     .phase = scene.medium.phase,
                                     .extinction = extinction,
                                     .sky_distance = sky_distance,
                                     .scattered = {},
                                     .light_transmittance = lit},
                        "which surfaces the lights reach"});
  return lit;
}

// Absent where the scene has nothing to scatter or to receive, or the knob does not ask for it.
Image FramePlan::add_indirect() {
  const Medium& medium = scene.medium;
  const std::string_view choice = request.knobs.choice("indirect");
  const bool psf = choice == "psf";
  const bool scatters = (medium.extinction > 0 && medium.albedo != glm::dvec3(0)) || depth_toward_light_;
  const bool any = scatters && !lights.empty() && has_surfaces();
  if (!any || choice == "off") {
    plan.skips.push_back(
        {Rule::no_indirect, "indirect single scattering", any ? "indirect = off" : "no light, no surface or nothing scatters"});
    return {};
  }
  if ((psf || choice == "mean_density") && !depth_toward_light_) {
    const bool uneven = !gaussians_of(scene).empty() || medium.grid;
    plan.skips.push_back({Rule::no_indirect, "light that Gaussians and grids scatter onto surfaces",
                          uneven ? "they absorb all" : "there is none"});
  }
  if (psf && medium.phase.kind != PhaseKind::isotropic)
    throw InputError("setting indirect: psf is of the isotropic phase function, the scene has another");
  const std::vector<Material> materials = materials_of(scene);
  const std::vector<float> shininess = shininess_of(materials);
  Hash key;
  key.add(std::string_view(psf ? "surface psf" : "surface airlight"));
  key.add(medium.phase);
  key.add(shininess);
  const std::size_t floats = (1 + shininess.size()) * (psf ? surface_psf_floats : surface_airlight_floats);
  const Buffer tables{{indirect_tables_id}, sizeof(float) * floats};
  plan.uploads.push_back(table_upload(tables, key.value(), [psf, phase = medium.phase, shininess] {
    return psf ? surface_psf_tables(shininess) : surface_airlight_tables(phase, shininess);
  }));
  // More may be added to it.
  const bool last = !scene.environment || lacks_environment_indirect();
  const Image indirect = last ? image("surface.indirect", Format::rgb32f) : handed_on(next_id_++, Format::rgb32f, 1);
  plan.steps.push_back({SurfaceAirlight{.distance = distance,
                                        .normal = normal,
                                        .material = material,
                                        .transmittance = transmittance,
                                        .depth_toward_light = depth_toward_light_,
                                        .tables = tables,
                                        .materials = materials,
                                        .lights = lights,
                                        .view = view,
                                        .extinction = extinction,
                                        .albedo = medium.albedo,
                                        .rest_albedo = depth_toward_light_ ? rest_albedo() : glm::vec3(1),
                                        .scattering = psf ? SurfaceScattering::psf : SurfaceScattering::tables,
                                        .indirect = indirect},
                        brdfs.all.empty()
                            ? "light scattered once on its way to the surfaces"
                            : "light scattered once on its way to the surfaces; tabulated reflectances as the Lambert and "
                              "Phong lobes nearest to them"});
  return indirect;
}

void FramePlan::shade_through(LightMarch way, Buffer volumes, std::uint32_t first_id) {
  const Image lit = add_lit(volumes, first_id);
  const bool uneven = !way.gaussians.empty() || way.grid;
  if (!uneven || !has_surfaces() || lights.empty()) {
    if (uneven) plan.skips.push_back({Rule::no_light_march, "light_march", has_surfaces() ? "no light" : "no surface"});
    shade(lit);
    return;
  }
  way.distance = distance, way.lit = lit, way.lights = of_unit_power(lights), way.view = view;
  way.light_transmittance = handed_on(first_id + 1, Format::r32f, static_cast<int>(lights.size()));
  if (rest_scatters()) depth_toward_light_ = handed_on(next_id_++, Format::r32f, static_cast<int>(lights.size()));
  way.depth_toward_light = depth_toward_light_;
  plan.steps.push_back({way, "what of each light reaches the surfaces"});
  shade(way.light_transmittance);
}

// Absent where no surface has a tabulated reflectance or no light is there to ask for it.
Buffer FramePlan::add_brdfs() {
  if (brdfs.all.empty()) return {};
  if (lights.empty()) {
    plan.skips.push_back({Rule::no_reflectances, "tables of reflectances", "no light"});
    return {};
  }
  std::size_t values = 0;
  for (const auto& b : brdfs.all) values += 3 + b->values.size() + b->values.size() / static_cast<std::size_t>(b->size.z);
  const Buffer tables{{brdf_id}, values * sizeof(float)};
  plan.uploads.push_back(table_upload(tables, brdfs.key, [all = brdfs.all] { return brdf_tables(all); }));
  return tables;
}

void FramePlan::shade(Image light_transmittance) {
  const Image indirect = add_environment_indirect(add_indirect());
  const Image environment = add_environment();
  const Buffer tables = add_brdfs();
  plan.steps.push_back({SurfaceShading{.distance = distance,
                                       .normal = normal,
                                       .material = material,
                                       .transmittance = transmittance,
                                       .light_transmittance = light_transmittance,
                                       .indirect = indirect,
                                       .environment = environment,
                                       .brdfs = tables,
                                       .materials = brdfs.without_lobes(materials_of(scene)),
                                       .brdf = tables ? brdfs.of_surface : std::vector<int>{},
                                       .brdf_at = tables ? brdf_places(brdfs.all) : std::vector<int>{},
                                       .lights = lights,
                                       .view = view,
                                       .extinction = extinction,
                                       .ambient = ambient,
                                       .background = scene.background,
                                       .surface = surface_,
                                       .surface_direct = surface_direct_,
                                       .surface_ambient = surface_ambient_},
                        "direct light on the surfaces, attenuated on both ways"});
}

Plan FramePlan::finish() {
  if (const auto scattered = take_environment_airlight())
    plan.steps.push_back({*scattered, "the environment's light, scattered once along the view ray"});
  plan.steps.push_back({Compose{.surface = surface_, .airlight = airlight, .beauty = beauty_}, "surface + airlight"});
  return std::move(plan);
}

}  // namespace airlight
