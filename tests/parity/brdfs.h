// Reflectances of the tests: microfacets, and tables of them.
#pragma once

#include <glm/vec3.hpp>
#include <memory>

#include "common/scene/scene.h"

namespace airlight {

// Trowbridge and Reitz's microfacets with Smith's shadowing of both directions (Walter et al. 2007, Heitz 2014) and Schlick's
// Fresnel term, by cosines: of the half vector with the normal and with the light, of the normal with the light and the viewer.
glm::dvec3 microfacets(double roughness, double half, double difference, double light, double viewer);

// The same in the centres of a table's cells; cosines below the horizon are held at 0.01. `squeeze` (0..1) makes it depend on
// phi_difference as no metal does, so that none of the axes can be taken for another.
std::shared_ptr<const Brdf> microfacet_table(const glm::ivec3& size, double roughness, double squeeze = 0);

// The same reflectance everywhere.
std::shared_ptr<const Brdf> constant_table(const glm::vec3& reflectance);

}  // namespace airlight
