#include "common/reference/indirect.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <numbers>
#include <vector>

#include "common/formulas/double.h"
#include "common/reference/quadrature.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;

// The 15 nodes of Kronrod's rule on each piece.
template <class F>
double sum_over(const std::vector<double>& breaks, F&& f) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double middle = (breaks[i] + breaks[i + 1]) / 2, reach = (breaks[i + 1] - breaks[i]) / 2;
    if (!(reach > 0)) continue;
    double piece = 0;
    for (const KronrodNode& node : kronrod_nodes) {
      piece += node.kronrod * (node.x > 0 ? f(middle - reach * node.x) + f(middle + reach * node.x) : f(middle));
    }
    sum += reach * piece;
  }
  return sum;
}

std::vector<double> sorted(std::initializer_list<double> inner, double low, double high) {
  std::vector<double> breaks{low};
  for (const double b : inner) {
    if (b > low && b < high) breaks.push_back(b);
  }
  breaks.push_back(high);
  std::sort(breaks.begin(), breaks.end());
  return breaks;
}

// Light that scatters into a ray at the angle gamma from the light, times sin(gamma); the light at distance 1. With x = foot + h
// sinh(s) the way there and on to the light is foot + h e^s.
double ray_times_sine(const Phase& phase, double lambda, double gamma) {
  const double h = std::sin(gamma), foot = std::cos(gamma);
  if (!(h > 0) || !(lambda > 0)) return 0;
  const double from = std::asinh(-foot / h), to = std::log((1 + 45 / lambda - foot) / h);
  const double fade = std::log(1 / (lambda * h));
  return lambda * sum_over(sorted({-4, -1, 1.5, fade - 1}, from, to), [&](double s) {
           const double e = std::exp(s), inverse = 1 / e;  // cosh and tanh of s
           const double p = f64::phase_value(static_cast<int>(phase.kind), phase.g, (inverse - e) / (e + inverse));
           return p * std::exp(-lambda * (foot + h * e)) * 2 / (e + inverse);
         });
}

// max(0, cos)^exponent about a direction phi away, integrated around the light's direction at gamma.
double around(double gamma, double phi, double exponent) {
  const double a = std::cos(phi) * std::cos(gamma), b = std::sin(phi) * std::sin(gamma);
  if (a + b <= 0) return 0;
  const double end = a > b ? pi : std::acos(std::max(-a / b, -1.0));
  if (exponent == 1) return 2 * (a * end + b * std::sin(end));
  // Where the lobe has fallen to 1e-15 of its top.
  const double least = (a + b) * std::exp(-35 / std::max(exponent, 1e-9));
  const double stop = b > 0 && (least - a) / b > -1 ? std::min(end, std::acos(std::min((least - a) / b, 1.0))) : end;
  return 2 * sum_over({0, stop / 3, 2 * stop / 3, stop}, [&](double psi) {
           const double half_sine = std::sin(psi / 2), cosine = std::cos(gamma - phi) - 2 * b * half_sine * half_sine;
           return cosine > 0 ? std::pow(cosine, exponent) : 0;
         });
}

}  // namespace

double indirect_lobe(const Phase& phase, bool directional, double lambda, double phi, double exponent) {
  const double width = std::acos(std::exp(-35 / std::max(exponent, 1e-9)));
  const double low = std::max(0.0, phi - width), high = std::min(pi, phi + width), kink = std::fabs(pi / 2 - phi);
  const double back = phase.g < 0 ? pi - 0.05 : low;  // a peak there, as there may be one ahead
  const std::vector<double> breaks =
      exponent == 1
          ? sorted({kink, pi - kink, kink + 0.05, 0.05, back}, low, high)
          : sorted({kink, pi - kink, phi, phi - width / 3, phi + width / 3, phi - width / 10, phi + width / 10, 0.05, back}, low,
                   high);
  return sum_over(breaks, [&](double gamma) {
    const double lobe = around(gamma, phi, exponent);
    if (lobe == 0) return 0.0;
    return lobe * (directional ? f64::phase_value(static_cast<int>(phase.kind), phase.g, std::cos(gamma)) * std::sin(gamma)
                               : ray_times_sine(phase, lambda, gamma));
  });
}

glm::dvec3 indirect_reflection(const Medium& medium, const RelativeLight& light, const glm::dvec3& point,
                               const glm::dvec3& normal, const glm::dvec3& mirror, const Material& material) {
  const glm::dvec3 way = light.directional ? -light.vector : light.vector - point;
  const double length = glm::length(way), r = std::max(length, light.radius);
  const double scale = light.directional ? 1 : 1 / (r * r), lambda = medium.extinction * length;
  const auto angle = [&](const glm::dvec3& axis) { return std::acos(std::clamp(glm::dot(axis, way) / length, -1.0, 1.0)); };
  const auto lobe = [&](const glm::dvec3& axis, double exponent) {
    return scale * indirect_lobe(medium.phase, light.directional, lambda, angle(axis), exponent);
  };
  glm::dvec3 sum(0);
  if (material.diffuse != glm::vec3(0)) sum += glm::dvec3(material.diffuse) / pi * lobe(normal, 1);
  if (material.specular != glm::vec3(0)) {
    const auto n = static_cast<double>(material.shininess);
    sum += glm::dvec3(material.specular) * ((n + 1) / (2 * pi) * lobe(mirror, n));
  }
  return sum;
}

}  // namespace airlight
