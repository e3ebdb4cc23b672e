#pragma once

#include <vector>

#include "common/algorithms/environment_airlight.h"
#include "common/algorithms/field.h"
#include "common/algorithms/view.h"

namespace airlight {

// Light of an environment that the medium scatters once before it arrives at surfaces, as it reaches the camera. The medium
// stands in it by its mean optical depth over all directions from the surface (Zhou et al. 2007, eq. 26), hidden by nothing; the
// homogeneous part lies around all of that, unbounded, as the light is given as it arrives through it. As the depths have it, or
// as printed in eq. 27.
struct EnvironmentIndirect {
  Image distance, normal, material, transmittance;  // as in SurfaceShading
  Image scattered;                                  // as SurfaceAirlight makes it: what else is indirect; optional
  Image mean_depth;                                 // as MeanDepth makes it; absent: 0
  // environment_indirect_table() of the phase function or of eq. 18's NPSF, common/plan/environment.h: for Lambert's lobe, then
  // for each of shininess_of(materials), environment_share()'s table and environment_reflection()'s.
  Buffer tables;
  std::vector<Material> materials;
  View view;
  glm::vec3 albedo{0, 0, 0};           // 0..1 of the homogeneous part; 0 without one
  glm::vec3 gaussian_albedo{1, 1, 1};  // 0..1 of the Gaussians, in the mean
  EnvironmentScattering scattering = EnvironmentScattering::depths;

  Image indirect;  // rgb32f [W/m^2/sr]; 0 where nothing is hit

  static constexpr std::string_view name = "environment_indirect";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("normal"), s.normal);
    v(in("material"), s.material);
    v(in("transmittance"), s.transmittance);
    v(in("scattered", "W/m^2/sr"), s.scattered);
    v(in("mean_depth"), s.mean_depth);
    v(in("tables"), s.tables);
    v(knob("materials"), s.materials);
    v(knob("view"), s.view);
    v(knob("albedo"), s.albedo);
    v(knob("gaussian_albedo"), s.gaussian_albedo);
    v(knob("scattering"), s.scattering);
    v(out("indirect", "W/m^2/sr"), s.indirect);
  }
};

}  // namespace airlight
