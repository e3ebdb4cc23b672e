#include "common/plan/zonal.h"

#include <cmath>
#include <numbers>

#include "common/formulas/double.h"
#include "common/plan/gauss_legendre.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;

// visit(x, weight) over 0..end, in pieces that halve toward 0.
template <class Visit>
void each_node(double end, Visit&& visit) {
  static const GaussLegendre rule(12);
  double high = end;
  for (int k = 0; k < 30; ++k) {
    const double low = k == 29 ? 0 : high / 2, half = (high - low) / 2;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      visit((low + high) / 2 + half * static_cast<double>(rule.node[i]), half * static_cast<double>(rule.weight[i]));
    }
    high = low;
  }
}

// Of a function that may be steep at both ends, given times the sine of the angle.
template <class F>
Zonal projected(F&& times_sine) {
  Zonal g{};
  const auto add = [&](double gamma, double weight) {
    double v[36];
    f64::sh_basis(6, std::sin(gamma), 0, std::cos(gamma), v);
    const double value = 2 * pi * weight * times_sine(gamma);
    for (std::size_t l = 0; l < 6; ++l) g[l] += value * v[l * (l + 1)];
  };
  each_node(pi / 2, [&](double gamma, double weight) { add(gamma, weight), add(pi - gamma, weight); });
  return g;
}

// F(sin(gamma), pi/2) - F(sin(gamma), gamma/2), F(u, v) = int_0^v exp(-u tan(xi)) dxi, from the other end: xi = pi/2 - t.
double npsf_times_sine(double gamma) {
  const double u = std::sin(gamma);
  double difference = 0;
  each_node((pi - gamma) / 2, [&](double t, double weight) { difference += weight * std::exp(-u / std::tan(t)); });
  return difference / (2 * pi * std::exp(std::cos(gamma) - 1));
}

}  // namespace

double npsf(double gamma) { return npsf_times_sine(gamma) / std::sin(gamma); }

Zonal npsf_coefficients() { return projected(npsf_times_sine); }

Zonal phase_coefficients(const Phase& phase) {
  return projected(
      [&](double gamma) { return f64::phase_value(static_cast<int>(phase.kind), phase.g, std::cos(gamma)) * std::sin(gamma); });
}

}  // namespace airlight
