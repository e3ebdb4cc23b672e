// Sums over the directions of light and viewer of a tabulated reflectance.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <numbers>

#include "common/scene/brdf.h"

namespace airlight {

// The mean of both sides of the plane of view, which an isotropic surface reflects alike but for errors of measurement.
inline Brdf both_sides(const Brdf& brdf) {
  Brdf mean = brdf;
  const std::ptrdiff_t phis = brdf.size.z;
  for (auto row = mean.values.begin(); row != mean.values.end(); row += phis) {
    for (std::ptrdiff_t k = 0; 2 * k < phis; ++k) row[k] = row[phis - 1 - k] = 0.5F * (row[k] + row[phis - 1 - k]);
  }
  return mean;
}

// visit(to the light, solid angle, what is sent per unit of irradiance on a plane that faces it) for one viewing angle, on one
// side of the plane of view, in the frame of normal (z) and viewer (x); solid angles count for both sides. By midpoints of half
// vectors, in rings as wide as the table's cells or narrower: light from a solid angle of 4 cos(theta_difference) has its half
// vector in one of 1 (Walter et al. 2007, eq. 14).
template <class Visit>
void each_direction(const Brdf& brdf, double level, Visit&& visit) {
  constexpr double pi = std::numbers::pi;
  constexpr int least_rings = 96, azimuths = 64;  // of half vectors
  const int cells = brdf.size.x, rings = cells * ((least_rings + cells - 1) / cells);
  const double slope = std::sqrt((1 - level) * (1 + level));
  for (int k = 0; k < rings; ++k) {
    const double q = (k + 0.5) / rings, theta = q * q * pi / 2;
    const double sine = std::sin(theta), cosine = std::cos(theta), ring = sine * (q * pi / rings) * 2 * (pi / azimuths);
    for (int i = 0; i < azimuths; ++i) {  // of one side of the plane
      const double azimuth = pi * (i + 0.5) / azimuths, x = sine * std::cos(azimuth), y = sine * std::sin(azimuth);
      const double along = x * slope + cosine * level;  // of the half vector and the viewer
      const double lx = 2 * along * x - slope, ly = 2 * along * y, lz = 2 * along * cosine - level;
      if (!(along > 0) || !(lz > 0)) continue;
      const glm::dvec3 light(lx, ly, lz);
      visit(light, 4 * along * ring, tabulated_reflection(brdf, {0, 0, 1}, light, {slope, 0, level}));
    }
  }
}

// visit(cosine of the viewing angle, weight) by midpoints of the squared cosine, by which all directions count for as much as
// they send or take; the weights add up to 1.
template <class Visit>
void each_view(Visit&& visit) {
  constexpr int views = 12;
  for (int i = 0; i < views; ++i) visit(std::sqrt((i + 0.5) / views), 1.0 / views);
}

}  // namespace airlight
