// An oracle for single scattering along a ray, independent of tables and of the boundary functions: the defining integral over
// the angle at the light, by adaptive Gauss-Legendre in double.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "common/algorithms/view.h"
#include "common/formulas/double.h"

namespace airlight {

// int_0^length sigma_t p(mu) exp(-sigma_t (x + r)) / r^2 dx. With x = foot + h tan(a) the 1/r^2 is gone: dx / r^2 = da / h.
inline double airlight_truth(Phase phase, double sigma_t, double foot, double h, double x0, double x1) {
  const auto integrand = [&](double a) {
    const double r = h / std::cos(a), x = foot + h * std::tan(a);
    return f64::phase_value(static_cast<int>(phase.kind), phase.g, -std::sin(a)) * std::exp(-sigma_t * (x + r));
  };
  // 15 nodes on a panel against two halves of it, until they agree.
  static constexpr std::array node{0.0,
                                   0.20119409399743452,
                                   0.39415134707756337,
                                   0.57097217260853885,
                                   0.72441773136017005,
                                   0.84820658341042722,
                                   0.93727339240070590,
                                   0.98799251802048543};
  static constexpr std::array weight{0.20257824192556127, 0.19843148532711158, 0.18616100001556221, 0.16626920581699393,
                                     0.13957067792615431, 0.10715922046717194, 0.07036604748810812, 0.03075324199611727};
  const auto panel = [&](double a, double b) {
    const double middle = (a + b) / 2, reach = (b - a) / 2;
    double sum = weight[0] * integrand(middle);
    for (std::size_t k = 1; k < node.size(); ++k) {
      sum += weight[k] * (integrand(middle - reach * node[k]) + integrand(middle + reach * node[k]));
    }
    return sum * reach;
  };
  double enough = 0;  // an error that does not matter to the whole
  const auto adapt = [&](auto&& self, double a, double b, double whole, int depth) -> double {
    const double middle = (a + b) / 2, left = panel(a, middle), right = panel(middle, b);
    if (depth > 24 || std::fabs(left + right - whole) <= std::max(1e-11 * std::fabs(left + right), enough)) return left + right;
    return self(self, a, middle, left, depth + 1) + self(self, middle, b, right, depth + 1);
  };
  const double from = std::atan2(x0 - foot, h), to = x1 >= 1e29 ? std::acos(0.0) * (1 - 1e-16) : std::atan2(x1 - foot, h);
  constexpr int panels = 8;
  std::array<double, panels> rough{};
  const auto end = [&](int k) { return from + (to - from) * k / panels; };
  double estimate = 0, sum = 0;
  for (int k = 0; k < panels; ++k) estimate += rough[static_cast<std::size_t>(k)] = panel(end(k), end(k + 1));
  enough = 1e-12 * estimate;
  for (int k = 0; k < panels; ++k) sum += adapt(adapt, end(k), end(k + 1), rough[static_cast<std::size_t>(k)], 0);
  return sigma_t * sum / h;
}

}  // namespace airlight
