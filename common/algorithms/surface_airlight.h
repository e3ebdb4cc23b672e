#pragma once

#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/view.h"

namespace airlight {

// Indirect single scattering on the surfaces: light that scatters once in the medium, taken as homogeneous, unbounded and without
// shadows, before it arrives there (Biri et al. 2006, III-C; common/formulas/surface_airlight.h); as it reaches the camera.
struct SurfaceAirlight {
  Image distance, normal, material, transmittance;  // as in SurfaceShading
  Buffer tables;  // of the phase function and shininess_of(materials), common/plan/surface_airlight_tables.h
  std::vector<Material> materials;
  std::vector<Light> lights;
  View view;
  float extinction = 0;       // [1/m], > 0
  glm::vec3 albedo{1, 1, 1};  // single-scattering albedo, 0..1

  Image indirect;  // rgb32f [W/m^2/sr]; 0 where nothing is hit

  static constexpr std::string_view name = "surface_airlight";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("normal"), s.normal);
    v(in("material"), s.material);
    v(in("transmittance"), s.transmittance);
    v(in("tables"), s.tables);
    v(knob("materials"), s.materials);
    v(knob("lights"), s.lights);
    v(knob("view"), s.view);
    v(knob("extinction", "1/m"), s.extinction);
    v(knob("albedo"), s.albedo);
    v(out("indirect", "W/m^2/sr"), s.indirect);
  }
};

}  // namespace airlight
