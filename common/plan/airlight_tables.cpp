#include "common/plan/airlight_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/formulas/double.h"

namespace airlight {

namespace {

// A quadrature rule on [0, 1]: Gauss-Legendre of eight nodes on panels graded toward both ends. Toward 0 lie the flat start of
// exp(-lambda cot(s/2)) and a phase function's backward peak, toward 1 the boundary layer of dense media and a forward peak.
struct Rule {
  static constexpr std::array edges{0.0, 1e-4, 5e-4, 2.5e-3, 0.0125, 0.06, 0.25, 0.5, 0.75, 0.94, 0.9875, 0.9975, 1.0};
  static constexpr std::array half{0.18343464249564980, 0.52553240991632899, 0.79666647741362674, 0.96028985649753623};
  static constexpr std::array half_weight{0.36268378337836198, 0.31370664587788729, 0.22238103445337447, 0.10122853629037626};
  static constexpr std::size_t size = (edges.size() - 1) * 8;

  std::array<double, size> node{}, weight{};

  constexpr Rule() {
    std::size_t k = 0;
    for (std::size_t panel = 0; panel + 1 < edges.size(); ++panel) {
      const double middle = (edges[panel + 1] + edges[panel]) / 2, reach = (edges[panel + 1] - edges[panel]) / 2;
      for (std::size_t i = 0; i < 4; ++i) {
        for (const double side : {-1.0, 1.0}) {
          node[k] = middle + side * reach * half[i];
          weight[k++] = reach * half_weight[i];
        }
      }
    }
  }
};

// sum_k weight_k exp(-lambda exponent_k)
struct ExponentialSum {
  std::array<double, Rule::size> weight, exponent;

  double operator()(double lambda) const {
    double sum = 0;
    for (std::size_t k = 0; k < Rule::size; ++k) sum += weight[k] * std::exp(-lambda * exponent[k]);
    return sum;
  }
};

constexpr Rule rule;

bool has_peak(Phase phase) { return phase.kind == PhaseKind::henyey_greenstein || phase.kind == PhaseKind::cornette_shanks; }

double phase_at(Phase phase, double mu) { return f64::phase_value(static_cast<int>(phase.kind), phase.g, mu); }

// int_0^delta p(-cos s) exp(-lambda (cot(s/2) - cot(delta/2))) ds
ExponentialSum beyond(Phase phase, double delta) {
  ExponentialSum sum;
  for (std::size_t k = 0; k < Rule::size; ++k) {
    const double s = delta * rule.node[k];
    sum.weight[k] = delta * rule.weight[k] * phase_at(phase, -std::cos(s));
    sum.exponent[k] = std::sin((delta - s) / 2) / (std::sin(s / 2) * std::sin(delta / 2));
  }
  return sum;
}

// int_delta^pi p(-cos s) exp(-lambda cot(s/2)) ds, from the other end: s = pi - s', delta = pi - delta'
ExponentialSum before(Phase phase, double delta_rest) {
  ExponentialSum sum;
  for (std::size_t k = 0; k < Rule::size; ++k) {
    const double s = delta_rest * rule.node[k];
    sum.weight[k] = delta_rest * rule.weight[k] * phase_at(phase, std::cos(s));
    sum.exponent[k] = std::tan(s / 2);
  }
  return sum;
}

}  // namespace

int airlight_table_nodes(Phase phase, int nodes) {
  // Measured: with these the error stays what it is without a peak, up to |g| = 0.96.
  const double g = has_peak(phase) ? std::fabs(phase.g) : 0;
  const int halves = g <= 0.55 ? 2 : g <= 0.85 ? 3 : g <= 0.92 ? 4 : g <= 0.96 ? 6 : 8;
  return std::clamp(nodes * halves / 2, 8, 512);
}

std::size_t airlight_table_floats(Phase phase, int nodes) {
  const auto n = static_cast<std::size_t>(airlight_table_nodes(phase, nodes));
  return 4 + 3 * n * n;
}

std::vector<float> airlight_tables(Phase phase, int nodes) {
  const auto n = static_cast<std::size_t>(airlight_table_nodes(phase, nodes));
  // A peak of width 1 - |g| in angle needs the fine end of the angle axis; without one, 0.6 is best for the layer of N in dense
  // media.
  const bool peaked = has_peak(phase);
  const double width = peaked ? std::clamp(4 * (1 - std::fabs(phase.g)), 0.06, 0.6) : 0.6;
  const double w_beyond = phase.g < 0 ? width : 0.6, w_before = phase.g > 0 ? width : 0.6;

  // The inverse of the axes.
  const double top = std::pow(100.0 / 130.0, 0.25), last = static_cast<double>(n - 1);
  const auto depth_at = [&](std::size_t i) {
    const double q = std::pow(top * static_cast<double>(i) / last, 4);
    return 30 * q / (1 - q);
  };
  const auto tau_at = [&](std::size_t j, double w) {
    const double y = static_cast<double>(j) / last;
    return std::max(w * y / (1 + w - y), 1e-9);
  };

  std::vector<float> table(airlight_table_floats(phase, nodes));
  table[0] = static_cast<float>(n);
  table[1] = static_cast<float>(w_beyond);
  table[2] = static_cast<float>(w_before);
  const auto entry = [&](std::size_t which, std::size_t i, std::size_t j) -> float& {
    return table[4 + (which * n + i) * n + j];
  };
  for (std::size_t j = 0; j < n; ++j) {
    const double tau = tau_at(j, static_cast<double>(table[1]));
    const double delta = 2 * std::atan(tau), sine = std::sin(delta);
    const ExponentialSum near_end = beyond(phase, delta), far_end = beyond(phase, std::numbers::pi - delta);
    const double tau_n = tau_at(j, static_cast<double>(table[2]));
    const double delta_n = 2 * std::atan(tau_n), sine_n = std::sin(delta_n);
    const ExponentialSum behind = before(phase, delta_n);
    for (std::size_t i = 0; i < n; ++i) {
      const double rho = depth_at(i);
      entry(0, i, j) = static_cast<float>(near_end(rho * sine) / sine * (1 + 2 * rho));
      entry(1, i, j) = static_cast<float>(behind(rho * sine_n) / sine_n * (1 + 2 * rho * tau_n * tau_n));
      entry(2, i, j) = static_cast<float>(far_end(rho) * (1 + rho));
    }
  }
  return table;
}

}  // namespace airlight
