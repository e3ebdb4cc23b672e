// Indirect single scattering on surfaces in double, with what ends and shadows the rays that bring it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "common/reference/airlight.h"
#include "common/reference/quadrature.h"
#include "common/reference/visibility.h"
#include "common/scene/scene.h"

namespace airlight {

// A point of a surface as the camera sees it; unit vectors.
struct SurfacePoint {
  glm::dvec3 point{0};            // [m] relative to the camera
  glm::dvec3 normal{0}, face{0};  // of shading and of the triangle, both on the camera's side
  glm::dvec3 mirror{0};           // of the view ray about `normal`
  std::uint32_t triangle = 0;     // that it lies on
  const Surface* surface = nullptr;
};

// Radiance [W/m^2/sr] that the point sends to the camera's side of what one light scatters toward it once, and its estimated
// error: the rendering equation over the half space in front of the triangle, by the tabulated reflectance or `diffuse` / pi
// times the cosine and `specular` times the normalised Phong lobe, of rays as the camera's: they end at the first surface,
// whether it casts shadows or not; the medium is lit where no caster stands between it and the light (everywhere without
// `shadows`), through all of the medium; the distance from a lamp is held at its radius. A ray that meets nothing has no end,
// whatever `sky_distance` says. `tolerance`: relative, of the whole, 1e-7..1e-1.
//
// In polar coordinates about the direction to the light, where the sine takes the pole 1 / sin(gamma) of a lamp away (Biri,
// Michelin, Arques 2006, III-C); an adaptive quadrature over the azimuth of adaptive quadratures over gamma, cut where the first
// surface jumps.
Integral exact_indirect(const RelativeMedium&, const Visibility&, const RelativeLight&, const SurfacePoint&, bool shadows,
                        double tolerance);

}  // namespace airlight
