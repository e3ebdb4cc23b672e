// What the plans of all techniques make of a scene's environment.
#include <string>

#include "common/error.h"
#include "common/plan/environment.h"
#include "common/plan/frame.h"
#include "common/plan/frame_ids.h"
#include "common/plan/hash.h"
#include "common/plan/surface_airlight_tables.h"
#include "common/plan/upload.h"

namespace airlight {

Knob environment_knob() {
  return {.name = "environment_airlight",
          .kind = Knob::Kind::choice,
          .standard = "on",
          .least = 0,
          .most = 0,
          .choices = {"on", "published", "off"},
          .meaning =
              "an environment's light that the medium scatters once toward the camera: by the depths of each ray, as Zhou et al. "
              "print it for the isotropic phase function, or none",
          .sweep = {},
          .baselines = {"published"}};
}

std::optional<std::string> refuses_environment(const Scene& scene) {
  if (!scene.environment || !scene.medium.grid || scene.surfaces.empty()) return std::nullopt;
  return "an environment lights surfaces through fog and Gaussians, the scene has a grid";
}

// Where it will be added, airlight is handed on, and its depth is wanted.
void FramePlan::expect_environment_airlight() {
  if (!scene.environment) return;
  const std::string_view choice = request.knobs.choice("environment_airlight");
  if (scene.medium.empty() || choice == "off") {
    plan.skips.push_back({"airlight of the environment", scene.medium.empty() ? "no medium" : "environment_airlight = off"});
    return;
  }
  if (choice == "published" && scene.medium.phase.kind != PhaseKind::isotropic)
    throw InputError("setting environment_airlight: published is of the isotropic phase function, the scene has another");
  if (!optical_depth) optical_depth = handed_on(next_id_++, Format::r32f, 1);
  airlight_ = airlight;
  airlight = handed_on(next_id_++, Format::rgb32f, 1);
}

// After the technique's own airlight.
void FramePlan::add_environment_airlight() {
  if (!airlight_) return;
  const bool published = request.knobs.choice("environment_airlight") == "published";
  const Medium& medium = scene.medium;
  const Buffer tables{{environment_airlight_id}, 0};
  Hash key;
  key.add(std::string_view("environment airlight"));
  key.add(environment_key(*scene.environment, {}));
  key.add(published);
  key.add(medium.phase);
  plan.uploads.push_back(table_upload(tables, key.value(), [environment = *scene.environment, published, phase = medium.phase] {
    return environment_airlight_table(environment, published ? npsf_coefficients() : phase_coefficients(phase));
  }));
  plan.steps.push_back(
      {EnvironmentAirlight{.distance = distance,
                           .optical_depth = optical_depth,
                           .scattered = airlight,
                           .tables = tables,
                           .view = view,
                           .extinction = extinction,
                           .sky_distance = sky_distance,
                           .albedo = medium.albedo,
                           .gaussian_albedo = rest_albedo(),
                           .scattering = published ? EnvironmentScattering::published : EnvironmentScattering::depths,
                           .airlight = airlight_},
       "the environment's light, scattered once along the view ray"});
  airlight = airlight_;
}

// Absent without an environment.
Image FramePlan::add_environment() {
  if (!scene.environment) return {};
  const std::vector<Material> materials = materials_of(scene);
  const std::vector<float> shininess = shininess_of(materials);
  const Buffer tables{{environment_id}, 0};
  plan.uploads.push_back(
      table_upload(tables, environment_key(*scene.environment, shininess),
                   [environment = *scene.environment, shininess] { return environment_table(environment, shininess); }));
  const Image environment = image("surface.environment", Format::rgb32f);
  plan.steps.push_back({EnvironmentLight{.distance = distance,
                                         .normal = normal,
                                         .material = material,
                                         .transmittance = transmittance,
                                         .tables = tables,
                                         .materials = materials,
                                         .gaussians = has_surfaces() ? gaussians_of(scene) : std::vector<GaussianDensity>{},
                                         .view = view,
                                         .environment = environment},
                        "the environment, seen and on the surfaces"});
  return environment;
}

}  // namespace airlight
