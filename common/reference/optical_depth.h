// Optical depth of Gaussians along lines, in double, by the error function; accurate in the tails.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/scene/scene.h"

namespace airlight {

// int_start^(start+width) c exp(-a^2 (h^2 + (t - t_center)^2)) dt [1]; a [1/m] > 0, c [1/m], lengths [m], width >= 0 and
// possibly infinite. Relative error about 1e-13 down to the least normal double.
double gaussian_line_integral(double a, double c, double h, double t_center, double start, double width);

// A Gaussian seen from a line: density c exp(-a^2 (h^2 + (t - foot)^2)).
struct GaussianOnLine {
  double a = 1, c = 0, h = 0, foot = 0;

  GaussianOnLine(const Gaussian&, const glm::dvec3& origin, const glm::dvec3& unit_direction);
  double density(double t) const;                   // [1/m]
  double depth(double start, double width) const {  // [1]
    return gaussian_line_integral(a, c, h, foot, start, width);
  }
};

// sum over the Gaussians of the optical depth from `from` over `length` [m] (may be infinite) along a unit direction.
double optical_depth(const std::vector<Gaussian>&, const glm::dvec3& from, const glm::dvec3& unit_direction, double length);

// The same between two points.
double optical_depth(const std::vector<Gaussian>&, const glm::dvec3& from, const glm::dvec3& to);

}  // namespace airlight
