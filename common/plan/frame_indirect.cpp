// What the plans of all techniques make of light that scatters once on its way to surfaces, beyond the homogeneous part and
// lamps.
#include <string>

#include "common/error.h"
#include "common/plan/environment.h"
#include "common/plan/frame.h"
#include "common/plan/frame_ids.h"
#include "common/plan/hash.h"
#include "common/plan/surface_airlight_tables.h"
#include "common/plan/upload.h"

namespace airlight {

Knob environment_indirect_knob() {
  return choice_knob(
      "environment_indirect", {"off", "on", "published"},
      "an environment's light that the medium scatters once on its way to surfaces: none, by the mean depths of Gaussians "
      "and grids about each point, or as Zhou et al. print it for the isotropic phase function, of these alone");
}

// Of Gaussians, or of the grid: each counts as much as it holds.
glm::vec3 FramePlan::rest_albedo() const {
  const Medium& medium = scene.medium;
  if (medium.grid) return medium.grid->albedo;  // most of such a medium
  glm::dvec3 albedo(0);
  double all = 0;
  for (const Gaussian& g : medium.gaussians) {
    const double mass = g.extinction * g.radius * g.radius * g.radius;
    albedo += mass * g.albedo, all += mass;
  }
  return all > 0 ? albedo / all : medium.albedo;
}

// Whether lamps' light that Gaussians and a grid scatter onto surfaces is wanted, and there is any.
bool FramePlan::rest_scatters() const {
  const std::string_view choice = request.knobs.choice("indirect");
  const bool wanted = choice == "mean_density" || choice == "psf";
  return wanted && !lights.empty() && has_surfaces() && rest_albedo() != glm::vec3(0);
}

// Why an environment's light is not scattered onto surfaces; nothing where it is, or where there is no environment.
std::optional<std::string_view> FramePlan::lacks_environment_indirect() const {
  const std::string_view choice = request.knobs.choice("environment_indirect");
  if (choice == "off") return "environment_indirect = off";
  if (!has_surfaces()) return "no surface";
  const bool fog = choice == "on" && scene.medium.extinction > 0 && scene.medium.albedo != glm::dvec3(0);
  const bool rest = (!gaussians_of(scene).empty() || scene.medium.grid) && rest_albedo() != glm::vec3(0);
  if (!fog && !rest) return choice == "on" ? "nothing scatters" : "no Gaussian and no grid scatters";
  return std::nullopt;
}

// Adds it to what lamps and suns send, which may be absent.
Image FramePlan::add_environment_indirect(Image scattered) {
  if (!scene.environment) return scattered;
  if (const auto why = lacks_environment_indirect()) {
    plan.skips.push_back({Rule::environment_indirect, "indirect light of the environment", std::string(*why)});
    return scattered;
  }
  const bool published = request.knobs.choice("environment_indirect") == "published";
  const Medium& medium = scene.medium;
  if (published && medium.phase.kind != PhaseKind::isotropic)
    throw InputError("setting environment_indirect: published is of the isotropic phase function, the scene has another");
  const std::vector<Material> materials = materials_of(scene);
  const std::vector<float> shininess = shininess_of(materials);
  const Buffer tables{{environment_indirect_id}, sizeof(float) * environment_harmonics_at(shininess.size())};
  Hash key;
  key.add(std::string_view("environment indirect"));
  key.add(environment_key(*scene.environment, shininess));
  key.add(published);
  key.add(medium.phase);
  plan.uploads.push_back(
      table_upload(tables, key.value(), [environment = *scene.environment, shininess, published, phase = medium.phase] {
        return environment_indirect_table(environment, shininess, published ? npsf_coefficients() : phase_coefficients(phase));
      }));
  const Image depth = mean_depth();
  const Image indirect = image("surface.indirect", Format::rgb32f);
  plan.steps.push_back(
      {EnvironmentIndirect{.distance = distance,
                           .normal = normal,
                           .material = material,
                           .transmittance = transmittance,
                           .scattered = scattered,
                           .mean_depth = depth,
                           .tables = tables,
                           .materials = materials,
                           .view = view,
                           .albedo = medium.extinction > 0 ? glm::vec3(medium.albedo) : glm::vec3(0),
                           .gaussian_albedo = rest_albedo(),
                           .scattering = published ? EnvironmentScattering::published : EnvironmentScattering::depths,
                           .indirect = indirect},
       "the environment's light, scattered once on its way to the surfaces"});
  return indirect;
}

}  // namespace airlight
