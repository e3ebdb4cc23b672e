#pragma once

#include "common/algorithms/field.h"
#include "common/algorithms/view.h"

namespace airlight {

// How much of an environment's light the medium scatters once toward the camera: by the depths of the view ray in fog and
// Gaussians, of which the latter are taken to attenuate the light's way as they attenuate the ray's; or as Zhou et al. 2007 print
// it, eq. 28.
enum class EnvironmentScattering : int { depths, published };

// Adds it to the airlight, in front of surfaces too.
struct EnvironmentAirlight {
  Image distance, optical_depth;  // r32f; the depth of the whole medium, 1e30 where it is infinite
  Image scattered;                // rgb32f [W/m^2/sr]: what else is airlight
  Buffer tables;  // environment_reflection()'s of the environment convolved with the phase function, or with eq. 18's NPSF
  View view;
  float extinction = 0;                // [1/m] of the homogeneous part
  float sky_distance = 1e30F;          // [m]
  glm::vec3 albedo{1, 1, 1};           // 0..1 of the homogeneous part
  glm::vec3 gaussian_albedo{1, 1, 1};  // 0..1 of the Gaussians and the grid, in the mean
  EnvironmentScattering scattering = EnvironmentScattering::depths;

  Image airlight;  // rgb32f [W/m^2/sr]

  static constexpr std::string_view name = "environment_airlight";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("optical_depth"), s.optical_depth);
    v(in("scattered", "W/m^2/sr"), s.scattered);
    v(in("tables"), s.tables);
    v(knob("view"), s.view);
    v(knob("extinction", "1/m"), s.extinction);
    v(knob("sky_distance", "m"), s.sky_distance);
    v(knob("albedo"), s.albedo);
    v(knob("gaussian_albedo"), s.gaussian_albedo);
    v(knob("scattering"), s.scattering);
    v(out("airlight", "W/m^2/sr"), s.airlight);
  }
};

}  // namespace airlight
