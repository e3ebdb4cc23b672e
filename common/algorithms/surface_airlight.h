#pragma once

#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/view.h"

namespace airlight {

// By what: the tables of the homogeneous medium, or the point spread function of Zhou et al. 2007 for the isotropic phase
// function.
enum class SurfaceScattering : int { tables, psf };

// Indirect single scattering on the surfaces: light that scatters once in the medium, taken as unbounded and without shadows,
// before it arrives there; as it reaches the camera. Of the homogeneous part alone (Biri et al. 2006, III-C;
// common/formulas/surface_airlight.h); or of the whole medium as if between each light and the surface it were as dense as in the
// mean (Zhou et al. 2007, 4.3 and 4.1). Light that comes from infinitely far is scattered by Gaussians and the grid as if it came
// through them alone, and by the homogeneous part as that of any light that they attenuate; by the point spread function, by them
// alone.
struct SurfaceAirlight {
  Image distance, normal, material, transmittance;  // as in SurfaceShading
  Image depth_toward_light;                         // as LightMarch makes it; optional: of the homogeneous part alone
  // Of shininess_of(materials) and the phase function, common/plan/surface_airlight_tables.h, or surface_psf.h beside it.
  Buffer tables;
  std::vector<Material> materials;
  std::vector<Light> lights;
  View view;
  float extinction = 0;            // [1/m] of the homogeneous part; > 0 without depth_toward_light
  glm::vec3 albedo{1, 1, 1};       // 0..1 of the homogeneous part
  glm::vec3 rest_albedo{1, 1, 1};  // 0..1 of Gaussians and grid, in the mean
  SurfaceScattering scattering = SurfaceScattering::tables;

  Image indirect;  // rgb32f [W/m^2/sr]; 0 where nothing is hit

  static constexpr std::string_view name = "surface_airlight";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("normal"), s.normal);
    v(in("material"), s.material);
    v(in("transmittance"), s.transmittance);
    v(in("depth_toward_light"), s.depth_toward_light);
    v(in("tables"), s.tables);
    v(knob("materials"), s.materials);
    v(knob("lights"), s.lights);
    v(knob("view"), s.view);
    v(knob("extinction", "1/m"), s.extinction);
    v(knob("albedo"), s.albedo);
    v(knob("rest_albedo"), s.rest_albedo);
    v(knob("scattering"), s.scattering);
    v(out("indirect", "W/m^2/sr"), s.indirect);
  }
};

}  // namespace airlight
