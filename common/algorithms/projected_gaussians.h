#pragma once

#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/medium.h"
#include "common/algorithms/view.h"

namespace airlight {

// Single scattering along each pixel's ray in a sum of Gaussians and a homogeneous part as Zhou et al. 2007 publish it (sections
// 3 and 5.3), a baseline. What a Gaussian sends is sampled once, where its centre projects onto the ray, or at the end of the ray
// that is nearer (eq. 10 to 13): the Gaussian's own optical depth is right there, that of everything else is the one of the way
// from the light to its centre and on to the camera. The homogeneous part has its closed form, seen through the Gaussians between
// light and camera (eq. 15 to 17). Surfaces throw no shadows.
//
// Beyond what is printed: phase functions, albedos, directional lights, and emission, of Gaussians sampled like their scattering,
// of the homogeneous part as if the Gaussians on the ray were spread evenly over it.
struct ProjectedGaussians {
  Image distance;                // r32f [m], 1e30 on a miss
  Buffer tables;                 // as in HomogeneousAirlight; needed by point lights where extinction > 0
  Buffer bins;                   // which Gaussians the squares of the screen meet (common/plan/gaussian_bins.h)
  Buffer to_camera;              // float, a Gaussian each: optical depth of the other Gaussians from its centre to the camera
  std::vector<Buffer> to_light;  // one a light: the same from its centre to the light
  Buffer light_to_camera;  // float, a light each: optical depth of the Gaussians from it to the camera; absent without lights
  std::vector<Light> lights;
  std::vector<GaussianDensity> gaussians;  // at least one
  View view;
  Phase phase;
  float extinction = 0;         // [1/m] of the homogeneous part
  float sky_distance = 1e30F;   // [m]; 1e30 and above stand for infinity
  glm::vec3 albedo{1, 1, 1};    // of the homogeneous part, 0..1
  glm::vec3 ambient{0, 0, 0};   // [W/m^2/sr] source radiance L_a
  glm::vec3 emission{0, 0, 0};  // [W/m^3/sr] of the homogeneous part
  Erf erf = Erf::accurate;      // of the depths on the ray and from it to the lights

  Image airlight;       // rgb32f
  Image per_light;      // rgb32f, a layer a light, without ambient and emission; optional
  Image transmittance;  // r32f, 0..1
  Image optical_depth;  // r32f, optional; 1e30 where it is infinite

  static constexpr std::string_view name = "projected_gaussians";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("tables"), s.tables);
    v(in("bins"), s.bins);
    v(in("to_camera"), s.to_camera);
    v(in("to_light"), s.to_light);
    v(in("light_to_camera"), s.light_to_camera);
    v(knob("lights"), s.lights);
    v(knob("gaussians"), s.gaussians);
    v(knob("view"), s.view);
    v(knob("phase"), s.phase);
    v(knob("extinction", "1/m"), s.extinction);
    v(knob("sky_distance", "m"), s.sky_distance);
    v(knob("albedo"), s.albedo);
    v(knob("ambient", "W/m^2/sr"), s.ambient);
    v(knob("emission", "W/m^3/sr"), s.emission);
    v(knob("erf"), s.erf);
    v(out("airlight", "W/m^2/sr"), s.airlight);
    v(out("per_light", "W/m^2/sr"), s.per_light);
    v(out("transmittance"), s.transmittance);
    v(out("optical_depth"), s.optical_depth);
  }
};

}  // namespace airlight
