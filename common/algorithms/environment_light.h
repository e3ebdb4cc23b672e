#pragma once

#include <cstddef>
#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/view.h"

namespace airlight {

// The tables: for Lambert's lobe, then for each of shininess_of(materials), environment_share()'s table and
// environment_reflection()'s; where there are tabulated reflectances, the harmonics of brdf_environment(), then the lobes of
// each; then the image, environment_value()'s.
constexpr std::size_t environment_share_floats = 66, environment_lobe_floats = environment_share_floats + std::size_t{3} * 36;
constexpr int brdf_viewing_angles = 33;
constexpr std::size_t environment_harmonics_floats = std::size_t{3} * 36;
constexpr std::size_t brdf_lobe_floats = 13 + std::size_t{108} * brdf_viewing_angles;
constexpr std::size_t environment_harmonics_at(std::size_t shininess) { return (1 + shininess) * environment_lobe_floats; }
constexpr std::size_t brdf_lobes_at(std::size_t shininess, std::size_t number) {
  return environment_harmonics_at(shininess) + environment_harmonics_floats + number * brdf_lobe_floats;
}
constexpr std::size_t environment_image_at(std::size_t shininess, std::size_t brdfs = 0) {
  return brdfs > 0 ? brdf_lobes_at(shininess, brdfs) : environment_harmonics_at(shininess);
}

// Light of an environment as it reaches the camera: seen where no surface is hit, and reflected by surfaces. These take it from
// spherical harmonics of order 6 (Zhou et al. 2007, 4.2, eq. 26-27 without what is scattered on the way): attenuated by the mean
// optical depth over all directions, in front of nothing but the surface's own horizon and what is told as hidden.
struct EnvironmentLight {
  Image distance, normal, material, transmittance;  // as in SurfaceShading
  Image mean_depth;                                 // as MeanDepth makes it; absent: 0
  Buffer tables;                                    // common/plan/environment.h makes them
  Image hidden_diffuse, hidden_specular;            // as HiddenEnvironment makes them; optional. The latter of reflectances, too
  std::vector<Material> materials;
  std::vector<int> brdf;  // number of each material's tabulated reflectance, which stands for it, or -1; empty: none has one
  View view;

  Image environment;  // rgb32f [W/m^2/sr]

  static constexpr std::string_view name = "environment_light";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("normal"), s.normal);
    v(in("material"), s.material);
    v(in("transmittance"), s.transmittance);
    v(in("mean_depth"), s.mean_depth);
    v(in("tables"), s.tables);
    v(in("hidden_diffuse", "W/m^2/sr"), s.hidden_diffuse);
    v(in("hidden_specular", "W/m^2/sr"), s.hidden_specular);
    v(knob("materials"), s.materials);
    v(knob("brdf"), s.brdf);
    v(knob("view"), s.view);
    v(out("environment", "W/m^2/sr"), s.environment);
  }
};

}  // namespace airlight
