// Indirect single scattering on surfaces in double: of the unbounded homogeneous medium without shadows, as the techniques take
// it to be. What surfaces end and shadow is in indirect_exact.h. Independent of common/formulas/surface_airlight.h and its
// tables.
#pragma once

#include <glm/vec3.hpp>

#include "common/reference/visibility.h"
#include "common/scene/scene.h"

namespace airlight {

// Radiance that a surface point sends to the camera's side per unit of the light's power and of albedo: `diffuse` / pi times the
// irradiance, and `specular` times the normalised Phong lobe. Unit vectors: the normal and the mirror direction of the view ray.
// Point relative to the camera, as the light.
glm::dvec3 indirect_reflection(const Medium&, const RelativeLight&, const glm::dvec3& point, const glm::dvec3& normal,
                               const glm::dvec3& mirror, const Material&);

// The integrals that it is made of, per unit of I / l^2 (or of E), lambda = sigma_t l, phi the angle [rad] between the light and
// the normal or the mirror direction: of max(0, cos)^exponent, not normalised.
double indirect_lobe(const Phase&, bool directional, double lambda, double phi, double exponent);

}  // namespace airlight
