#include "common/reference/optical_depth.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/reference/quadrature.h"

namespace airlight {

namespace {

// int_u^(u+w) exp(-x^2) dx.
double gaussian_integral(double u, double w) {
  constexpr double half_sqrt_pi = 0.5 / std::numbers::inv_sqrtpi;
  const double v = u + w;
  const double middle = u + 0.5 * w;
  // A narrow interval: differences of erf would cancel. exp(-x^2) is exp(-m^2) times a function that varies by less than
  // e over it, which 15 nodes integrate to rounding.
  if (w < 0.5 && std::fabs(middle) * w < 1) {
    double sum = 0;
    for (const KronrodNode& node : kronrod_nodes) {
      for (const double side : {-0.5, 0.5}) {
        const double s = side * node.x * w;
        sum += node.kronrod * std::exp(-s * (2 * middle + s));
        if (node.x == 0) break;
      }
    }
    return 0.5 * w * sum * std::exp(-middle * middle);
  }
  if (u > 0) return half_sqrt_pi * (std::erfc(u) - std::erfc(v));
  if (v < 0) return half_sqrt_pi * (std::erfc(-v) - std::erfc(-u));
  return half_sqrt_pi * (std::erf(v) - std::erf(u));
}

}  // namespace

double gaussian_line_integral(double a, double c, double h, double t_center, double start, double width) {
  const double s = a * h;
  const double peak = c * std::exp(-s * s);
  if (!(peak > 0) || !(width > 0)) return 0;
  return peak / a * gaussian_integral(a * (start - t_center), a * width);
}

GaussianOnLine::GaussianOnLine(const Gaussian& g, const glm::dvec3& origin, const glm::dvec3& unit_direction)
    : a(1 / g.radius), c(g.extinction) {
  const glm::dvec3 p = g.center - origin;
  foot = glm::dot(unit_direction, p);
  h = glm::length(p - foot * unit_direction);  // |p|^2 - foot^2 would cancel
}

double GaussianOnLine::density(double t) const {
  const double x = a * (t - foot), y = a * h;
  return c * std::exp(-(x * x + y * y));
}

double optical_depth(const std::vector<Gaussian>& gaussians, const glm::dvec3& from, const glm::dvec3& unit_direction,
                     double length) {
  double sum = 0;
  for (const Gaussian& g : gaussians) {
    const GaussianOnLine line(g, from, unit_direction);
    if (line.a * line.h < 10) sum += line.depth(0, length);  // beyond, 1e-43 of its own depth
  }
  return sum;
}

double optical_depth(const std::vector<Gaussian>& gaussians, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 way = to - from;
  const double length = glm::length(way);
  return length > 0 && !gaussians.empty() ? optical_depth(gaussians, from, way / length, length) : 0;
}

}  // namespace airlight
