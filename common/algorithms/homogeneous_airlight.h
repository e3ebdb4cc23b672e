#pragma once

#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/view.h"

namespace airlight {

// Single scattering of the lights along each pixel's ray in the homogeneous medium, with its ambient and emitted light. Lights
// are unshadowed, or what scatters of them is given.
struct HomogeneousAirlight {
  Image distance;  // r32f [m], 1e30 on a miss
  Buffer
      tables;  // airlight tables of the phase function (common/plan/airlight_tables.h), float; needed by point lights in a medium
  Image scattered;  // r32f, a layer a light, as ShadowPlanes makes it; optional: then the tables are not needed
  std::vector<Light> lights;
  View view;
  Phase phase;
  float extinction = 0;         // [1/m]
  float sky_distance = 1e30F;   // [m]; 1e30 and above stand for infinity
  glm::vec3 albedo{1, 1, 1};    // single-scattering albedo, 0..1
  glm::vec3 ambient{0, 0, 0};   // [W/m^2/sr] source radiance L_a
  glm::vec3 emission{0, 0, 0};  // [W/m^3/sr]

  Image airlight;   // rgb32f: all lights, ambient and emission
  Image per_light;  // rgb32f, a layer a light, without ambient and emission; optional

  static constexpr std::string_view name = "homogeneous_airlight";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("tables"), s.tables);
    v(in("scattered"), s.scattered);
    v(knob("lights"), s.lights);
    v(knob("view"), s.view);
    v(knob("phase"), s.phase);
    v(knob("extinction", "1/m"), s.extinction);
    v(knob("sky_distance", "m"), s.sky_distance);
    v(knob("albedo"), s.albedo);
    v(knob("ambient", "W/m^2/sr"), s.ambient);
    v(knob("emission", "W/m^3/sr"), s.emission);
    v(out("airlight", "W/m^2/sr"), s.airlight);
    v(out("per_light", "W/m^2/sr"), s.per_light);
  }
};

}  // namespace airlight
