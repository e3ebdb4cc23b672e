#pragma once

#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/view.h"

namespace airlight {

// Radiance of the surfaces under point and directional lights, as it reaches the camera. A point light is attenuated by the
// homogeneous medium on its way to the surface, a directional one is given as it arrives.
struct SurfaceShading {
  Image distance, normal, material, transmittance;
  Image light_transmittance;  // r32f, one layer a light, 0..1; optional: what else stands in the light's way
  Image indirect;             // rgb32f, as SurfaceAirlight makes it; optional: added to `surface`
  Image environment;          // rgb32f, as EnvironmentLight makes it; optional: added to `surface`
  Buffer brdfs;               // brdf_tables() of common/plan/brdf.h; optional
  std::vector<Material> materials;
  std::vector<int> brdf;     // number of each material's tabulated reflectance, which stands for it under lights, or -1
  std::vector<int> brdf_at;  // where each of them begins in `brdfs`
  std::vector<Light> lights;
  View view;
  float extinction = 0;           // [1/m]
  glm::vec3 ambient{0, 0, 0};     // [W/m^2/sr] source radiance L_a: each surface adds diffuse * L_a
  glm::vec3 background{0, 0, 0};  // [W/m^2/sr] seen through the transmittance where no surface is hit

  Image surface;          // rgb32f: everything below, and the background
  Image surface_direct;   // rgb32f, optional
  Image surface_ambient;  // rgb32f, optional

  static constexpr std::string_view name = "surface_shading";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("normal"), s.normal);
    v(in("material"), s.material);
    v(in("transmittance"), s.transmittance);
    v(in("light_transmittance"), s.light_transmittance);
    v(in("indirect", "W/m^2/sr"), s.indirect);
    v(in("environment", "W/m^2/sr"), s.environment);
    v(in("brdfs", "1/sr"), s.brdfs);
    v(knob("materials"), s.materials);
    v(knob("brdf"), s.brdf);
    v(knob("brdf_at"), s.brdf_at);
    v(knob("lights"), s.lights);
    v(knob("view"), s.view);
    v(knob("extinction", "1/m"), s.extinction);
    v(knob("ambient", "W/m^2/sr"), s.ambient);
    v(knob("background", "W/m^2/sr"), s.background);
    v(out("surface", "W/m^2/sr"), s.surface);
    v(out("surface_direct", "W/m^2/sr"), s.surface_direct);
    v(out("surface_ambient", "W/m^2/sr"), s.surface_ambient);
  }
};

}  // namespace airlight
