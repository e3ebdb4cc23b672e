// What the plans of all techniques make of a scene's environment.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "common/error.h"
#include "common/plan/environment.h"
#include "common/plan/frame.h"
#include "common/plan/frame_ids.h"
#include "common/plan/hash.h"
#include "common/plan/hidden_environment.h"
#include "common/plan/surface_airlight_tables.h"
#include "common/plan/upload.h"

namespace airlight {

Knob environment_knob() {
  return choice_knob("environment_airlight", {"on", "published", "off"},
                     "an environment's light that the medium scatters once toward the camera: by the depths of each ray, as Zhou "
                     "et al. print it for the isotropic phase function, or none",
                     {}, {"published"});
}

Knob environment_shadows_knob() {
  return choice_knob(
      "environment_shadows", {"on", "off"},
      "what casters hide of an environment from surfaces: found once for their geometry, kept in a file by the program");
}

Knob environment_rays_knob() {
  return integer_knob("environment_rays", "256", 16, 65536,
                      "rays from each side of a vertex that find what casters hide of an environment");
}

// Where it will be added, airlight is handed on, and its depth is wanted.
void FramePlan::expect_environment_airlight() {
  if (!scene.environment) return;
  const std::string_view choice = request.knobs.choice("environment_airlight");
  if (scene.medium.empty() || choice == "off") {
    plan.skips.push_back({Rule::environment_airlight, "airlight of the environment",
                          scene.medium.empty() ? "no medium" : "environment_airlight = off"});
    return;
  }
  if (choice == "published" && scene.medium.phase.kind != PhaseKind::isotropic)
    throw InputError("setting environment_airlight: published is of the isotropic phase function, the scene has another");
  if (!optical_depth) optical_depth = handed_on(next_id_++, Format::r32f, 1);
  airlight_ = airlight;
  airlight = handed_on(next_id_++, Format::rgb32f, 1);
}

void FramePlan::scatter_environment_in_fog_alone() {
  environment_in_fog_alone_ = true;
  if (extinction > 0) return;
  airlight = airlight_;
  airlight_ = {};
  if (!optical_depth.keep) optical_depth = {};
  plan.skips.push_back(
      {Rule::environment_airlight, "environment_airlight", "no homogeneous medium, and what else scatters it is in the sources"});
}

std::optional<EnvironmentAirlight> FramePlan::take_environment_airlight() {
  if (!airlight_) return std::nullopt;
  const bool published = request.knobs.choice("environment_airlight") == "published";
  const Medium& medium = scene.medium;
  const Buffer tables{{environment_airlight_id}, sizeof(float) * environment_harmonics_floats};
  Hash key;
  key.add(std::string_view("environment airlight"));
  key.add(environment_key(*scene.environment, {}));
  key.add(published);
  key.add(medium.phase);
  plan.uploads.push_back(table_upload(tables, key.value(), [environment = *scene.environment, published, phase = medium.phase] {
    return environment_airlight_table(environment, published ? npsf_coefficients() : phase_coefficients(phase));
  }));
  const Image before = std::exchange(airlight, std::exchange(airlight_, Image{}));
  return EnvironmentAirlight{.distance = distance,
                             .optical_depth = optical_depth,
                             .scattered = before,
                             .tables = tables,
                             .view = view,
                             .extinction = extinction,
                             .sky_distance = sky_distance,
                             .albedo = medium.albedo,
                             .gaussian_albedo = environment_in_fog_alone_ ? glm::vec3(0) : rest_albedo(),
                             .scattering = published ? EnvironmentScattering::published : EnvironmentScattering::depths,
                             .airlight = airlight};
}

// Of what hides; without a source of transfers, at most.
std::function<HiddenSizes()> FramePlan::hiding_sizes() const {
  return [hiding = hiding_, source = request.transfer, rays = static_cast<int>(request.knobs.number("environment_rays"))] {
    return hidden_sizes(*hiding, source ? source->transfer(*hiding, rays).get() : nullptr);
  };
}

// Where surfaces hide anything, edges are cut and corners are wanted.
void FramePlan::expect_environment_shadows() {
  if (!scene.environment) return;
  const auto skip = [&](const char* why) {
    plan.skips.push_back({Rule::environment_shadows, "shadows in the environment's light", why});
  };
  if (!has_surfaces()) return skip("no surface");
  if (!std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                   [](const Surface& s) { return s.casts_shadow && !s.mesh->triangles.empty(); }))
    return skip("nothing casts a shadow");
  if (request.knobs.choice("environment_shadows") == "off") return skip("environment_shadows = off");
  const auto needless = [&](const Surface& s) {
    return !s.brdf && s.material.diffuse == glm::vec3(0) && s.material.specular == glm::vec3(0);
  };
  if (std::all_of(scene.surfaces.begin(), scene.surfaces.end(), needless)) return skip("the surfaces reflect nothing");
  constexpr std::size_t most_triangles = 1 << 22;  // they may be cut, and their numbers must stay below 2^24
  if (geometry.triangles > most_triangles) return skip("more than 2^22 triangles");

  const int rays = static_cast<int>(request.knobs.number("environment_rays"));
  transfer_key_ = transfer_key(scene, rays);
  // The uploads may outlive the scene: this shares its meshes.
  const auto part = std::make_shared<Scene>();
  part->camera = scene.camera, part->surfaces = scene.surfaces, part->environment = scene.environment;
  hiding_ = part;
  const auto cut = [&](Plan::Upload& upload, std::vector<std::byte> (*make)(const Scene&, const SurfaceTransfer&),
                       std::size_t HiddenSizes::*count, std::size_t bytes) {
    Hash key;
    key.add(upload.key), key.add(transfer_key_);
    upload.key = key.value();
    upload.most = [sizes = hiding_sizes(), count, bytes] { return bytes * sizes().*count; };
    upload.make = [hiding = hiding_, source = request.transfer, rays, make] {
      return make(*hiding, *source->transfer(*hiding, rays));
    };
  };
  cut(geometry.positions, cut_positions, &HiddenSizes::vertices, sizeof(glm::vec3));
  cut(geometry.normals, cut_normals, &HiddenSizes::vertices, sizeof(glm::vec3));
  cut(geometry.indices, cut_triangles, &HiddenSizes::triangles, sizeof(glm::uvec4));
  corners_ = handed_on(next_id_++, Format::rgb32f, 1);
}

void FramePlan::add_environment_shadows() {
  if (!corners_) return;
  const bool glossy = std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                                  [](const Surface& s) { return s.brdf || s.material.specular != glm::vec3(0); });
  hidden_diffuse_ = handed_on(next_id_++, Format::rgb32f, 1);
  if (glossy) hidden_specular_ = handed_on(next_id_++, Format::rgb32f, 1);
  // Of the materials the lobes alone, and tabulated reflectances.
  Hash key;
  key.add(std::string_view("hidden environment"));
  key.add(transfer_key_);
  key.add(environment_key(*scene.environment, {}));
  if (!brdfs.all.empty()) key.add(brdfs.key);
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const Material& m = scene.surfaces[i].material;
    const bool lobe = brdfs.of_surface[i] < 0 && m.specular != glm::vec3(0);
    key.add(brdfs.of_surface[i]);
    key.add(lobe);
    if (lobe) key.add(m.shininess);
  }
  const Buffer table{{hidden_environment_id}, 0};
  const int rays = static_cast<int>(request.knobs.number("environment_rays"));
  plan.uploads.push_back(table_upload(table, key.value(), [hiding = hiding_, source = request.transfer, rays] {
    return hidden_environment_table(*hiding, *source->transfer(*hiding, rays));
  }));
  plan.uploads.back().most = [sizes = hiding_sizes()] { return sizeof(float) * sizes().table; };
  plan.steps.push_back({HiddenEnvironment{.normal = normal,
                                          .corners = corners_,
                                          .triangles = geometry.indices.buffer,
                                          .table = table,
                                          .view = view,
                                          .brdfs = static_cast<int>(brdfs.all.size()),
                                          .diffuse = hidden_diffuse_,
                                          .specular = hidden_specular_},
                        "what surfaces hide of the environment from each other"});
}

// Absent without an environment.
Image FramePlan::add_environment() {
  if (!scene.environment) return {};
  const std::vector<Material> materials = brdfs.without_lobes(materials_of(scene));
  const std::vector<float> shininess = shininess_of(materials);
  const Buffer tables{{environment_id},
                      sizeof(float) * environment_table_floats(*scene.environment, shininess.size(), brdfs.all.size())};
  Hash key;
  key.add(environment_key(*scene.environment, shininess));
  if (!brdfs.all.empty()) key.add(brdfs.key);
  plan.uploads.push_back(table_upload(tables, key.value(), [environment = *scene.environment, shininess, all = brdfs.all] {
    return environment_table(environment, shininess, all);
  }));
  add_environment_shadows();
  const Image depth = mean_depth();
  const Image environment = image("surface.environment", Format::rgb32f);
  plan.steps.push_back({EnvironmentLight{.distance = distance,
                                         .normal = normal,
                                         .material = material,
                                         .transmittance = transmittance,
                                         .mean_depth = depth,
                                         .tables = tables,
                                         .hidden_diffuse = hidden_diffuse_,
                                         .hidden_specular = hidden_specular_,
                                         .materials = materials,
                                         .brdf = brdfs.all.empty() ? std::vector<int>{} : brdfs.of_surface,
                                         .view = view,
                                         .environment = environment},
                        "the environment, seen and on the surfaces"});
  return environment;
}

}  // namespace airlight
