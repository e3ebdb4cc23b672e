// Tabulated reflectances in double, independent of common/formulas/brdf.h and of harmonics, and what is told of them where the
// table itself is not asked.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "common/scene/scene.h"

namespace airlight {

namespace tabulated {

// Between the centres of two of n cells, of a place counted in cells.
struct Between {
  int low, high;
  double weight;
};

inline Between held(double place, int n) {
  const double at = std::clamp(place - 0.5, 0.0, n - 1.0);
  const int low = std::min(static_cast<int>(at), n - 2);
  return {low, low + 1, at - low};
}

inline Between around(double place, int n) {
  const double low = std::floor(place - 0.5);
  const int i = static_cast<int>(low) + n;
  return {i % n, (i + 1) % n, place - 0.5 - low};
}

}  // namespace tabulated

// What a surface sends toward the viewer per unit of irradiance on a plane that faces the light: the reflectance [1/sr] times the
// cosine, 0 where either is not above the horizon of the normal. Unit vectors. Rusinkiewicz 1998: the way to the light, turned so
// that the half vector is the axis.
inline glm::dvec3 tabulated_reflection(const Brdf& brdf, const glm::dvec3& normal, const glm::dvec3& to_light,
                                       const glm::dvec3& to_viewer) {
  using tabulated::Between;
  constexpr double pi = std::numbers::pi;
  const double cosine = glm::dot(normal, to_light);
  if (!(cosine > 0) || !(glm::dot(normal, to_viewer) > 0)) return glm::dvec3(0);
  // In a frame with the normal along z: turned about z until the half vector's azimuth is 0, then about y until it is the axis.
  const glm::dvec3 x = glm::normalize(std::fabs(normal.x) < 0.5 ? glm::cross(normal, {1, 0, 0}) : glm::cross(normal, {0, 1, 0}));
  const glm::dvec3 y = glm::cross(normal, x), half = glm::normalize(to_light + to_viewer);
  const double azimuth = std::atan2(glm::dot(half, y), glm::dot(half, x));
  const double theta = std::atan2(glm::length(glm::cross(normal, half)), glm::dot(normal, half));
  const double lx = glm::dot(to_light, x), ly = glm::dot(to_light, y);
  const double turned_x = std::cos(azimuth) * lx + std::sin(azimuth) * ly, dy = std::cos(azimuth) * ly - std::sin(azimuth) * lx;
  const double dx = std::cos(theta) * turned_x - std::sin(theta) * cosine,
               dz = std::sin(theta) * turned_x + std::cos(theta) * cosine;
  const double difference = std::atan2(std::hypot(dx, dy), dz);
  double phi = std::atan2(dy, dx);
  if (phi < 0) phi += pi;

  const glm::ivec3& n = brdf.size;
  const Between h = tabulated::held(std::sqrt(theta / (pi / 2)) * n.x, n.x),
                d = tabulated::held(difference / (pi / 2) * n.y, n.y), p = tabulated::around(phi / pi * n.z, n.z);
  glm::dvec3 sum(0);
  for (int c = 0; c < 3; ++c) {
    const auto row = [&](int i, int j) {
      const float* values = brdf.values.data() + ((static_cast<std::ptrdiff_t>(c) * n.x + i) * n.y + j) * n.z;
      return (1 - p.weight) * static_cast<double>(values[p.low]) + p.weight * static_cast<double>(values[p.high]);
    };
    const auto layer = [&](int i) { return (1 - d.weight) * row(i, d.low) + d.weight * row(i, d.high); };
    sum[c] = cosine * ((1 - h.weight) * layer(h.low) + h.weight * layer(h.high));
  }
  return sum;
}

// The share of the light that is reflected, of light that comes from everywhere the same: 0..1 where no more is reflected than
// arrives.
glm::dvec3 brdf_albedo(const Brdf&);

// The Lambert and Phong lobes nearest to it, for light that is not asked of the table: of the same albedo, held at 1, in the
// least squares over the directions of light and viewer, by exponents 1 to 1024 whose steps are the square root of 2.
Material brdf_material(const Brdf&);

}  // namespace airlight
