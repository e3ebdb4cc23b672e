// What every screen algorithm knows about the camera and the lights. All positions are relative to the camera (it sits at
// the origin) and in world orientation, so that single precision is enough wherever the scene lies.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/image.h"

namespace airlight {

// The ray of pixel (i, j) has direction x * right + y * up + forward, with
// x = (2 (i + .5 + offset.x) / W - 1) * tan_half_fov * W / H and y = (1 - 2 (j + .5 + offset.y) / H) * tan_half_fov.
// The formula stands in common/formulas/camera.h.
struct View {
  glm::vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};  // orthonormal
  float tan_half_fov = 0.41421357F;                          // of the vertical field of view
  float near_plane = 1e-4F;                                  // [m] along forward: nothing nearer is seen
  glm::vec2 offset{0, 0};                                    // [pixel] sub-pixel shift of the sample, each in -0.5..0.5
  Extent extent;
};

// A point light (directional = false): `vector` is its position [m], `power` its radiant intensity [W/sr], `radius` the
// distance [m] below which 1/r^2 is held. A directional light: `vector` is the unit direction in which light travels, `power` its
// irradiance [W/m^2] on a facing plane, as it arrives through the homogeneous medium.
struct Light {
  glm::vec3 vector{0, 0, 0};
  glm::vec3 power{0, 0, 0};
  float radius = 1e-3F;
  bool directional = false;
};

// The order is that of phase_value() in common/formulas/phase.h.
enum class PhaseKind : int { isotropic, rayleigh, henyey_greenstein, cornette_shanks, mie_hazy, mie_murky };

struct Phase {
  PhaseKind kind = PhaseKind::isotropic;
  double g = 0;  // -0.99..0.99, for henyey_greenstein and cornette_shanks
};

// Lambert + normalised Phong without a cosine on the specular term (docs: HACKING.md, conventions).
struct Material {
  glm::vec3 diffuse{0.5F, 0.5F, 0.5F};  // 0..1
  glm::vec3 specular{0, 0, 0};          // 0..1
  float shininess = 20;                 // 0..1e4
};

}  // namespace airlight
