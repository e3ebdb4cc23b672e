// Spherical harmonics by the C++ library, and sums over the sphere, for the checks.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/vec3.hpp>

namespace airlight {

// Gauss-Legendre of eight nodes.
constexpr std::array gauss_node{0.18343464249564980, 0.52553240991632899, 0.79666647741362674, 0.96028985649753623};
constexpr std::array gauss_weight{0.36268378337836198, 0.31370664587788729, 0.22238103445337447, 0.10122853629037626};

// int_a^b f in `panels` panels, finer toward b: t = b - (b - a) w^3.
template <class F>
double graded_integral(double a, double b, int panels, F&& f) {
  double sum = 0;
  for (int p = 0; p < panels; ++p) {
    for (std::size_t i = 0; i < 8; ++i) {
      const double side = i % 2 == 0 ? 0.5 : -0.5, w = (p + 0.5 + side * gauss_node[i / 2]) / panels;
      sum += gauss_weight[i / 2] * w * w * f(b - (b - a) * w * w * w);
    }
  }
  return sum * 1.5 * (b - a) / panels;
}

// visit(direction, weight): exact for polynomials of degree 15.
template <class Visit>
void each_direction(Visit&& visit) {
  for (std::size_t i = 0; i < 8; ++i) {
    const double z = i % 2 == 0 ? gauss_node[i / 2] : -gauss_node[i / 2], r = std::sqrt(1 - z * z);
    for (int k = 0; k < 16; ++k) {
      const double azimuth = std::numbers::pi * (k + 0.3) / 8;
      visit(glm::dvec3(r * std::cos(azimuth), r * std::sin(azimuth), z), gauss_weight[i / 2] * std::numbers::pi / 8);
    }
  }
}

// y_lm of a unit vector. The library's has the sign of Condon and Shortley.
inline double harmonic(int l, int m, const glm::dvec3& d) {
  const auto degree = static_cast<unsigned>(l), azimuthal = static_cast<unsigned>(std::abs(m));
  const double theta = std::atan2(std::hypot(d.x, d.y), d.z), phi = std::atan2(d.y, d.x);
  const double sign = m % 2 == 0 ? 1 : -1, polar = std::sph_legendre(degree, azimuthal, theta) * sign;
  if (m == 0) return polar;
  return polar * std::numbers::sqrt2 * (m > 0 ? std::cos(m * phi) : std::sin(-m * phi));
}

inline int band_of(int index) { return static_cast<int>(std::sqrt(index + 0.5)); }
inline double harmonic(int index, const glm::dvec3& d) {
  const int l = band_of(index);
  return harmonic(l, index - l * (l + 1), d);
}

}  // namespace airlight
