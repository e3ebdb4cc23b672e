#include "common/plan/surface_airlight_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "common/formulas/double.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t n = surface_airlight_depths, m = surface_airlight_angles;

// Gauss-Legendre of eight nodes.
constexpr std::array half_node{0.18343464249564980, 0.52553240991632899, 0.79666647741362674, 0.96028985649753623};
constexpr std::array half_weight{0.36268378337836198, 0.31370664587788729, 0.22238103445337447, 0.10122853629037626};

template <class Visit>  // visit(x, weight)
void panel(double a, double b, Visit&& visit) {
  const double middle = (a + b) / 2, reach = (b - a) / 2;
  for (std::size_t i = 0; i < half_node.size(); ++i) {
    visit(middle - reach * half_node[i], reach * half_weight[i]);
    visit(middle + reach * half_node[i], reach * half_weight[i]);
  }
}

// What a ray at gamma brings, times sin(gamma), by nodes over y: gamma = pi y^2 (3 - 2 y) is fine at both ends, where phase
// functions peak.
class Rays {
 public:
  explicit Rays(Phase phase) : kind_(static_cast<int>(phase.kind)), g_(phase.g) {}

  // int_0^delta p(-cos s) exp(-lambda sin(delta) (cot(s/2) - cot(delta/2))) ds, delta = pi - gamma.
  void prepare(double lambda) {
    for (std::size_t k = 0; k <= cells; ++k) {
      const double delta = pi - gamma_at(static_cast<double>(k) / cells);
      double sum = 0;
      if (delta > 1e-12) {
        for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
          panel(delta * edges[i], delta * edges[i + 1], [&](double s, double weight) {
            const double exponent = 2 * std::cos(delta / 2) * std::sin((delta - s) / 2) / std::sin(s / 2);
            sum += weight * f64::phase_value(kind_, g_, -std::cos(s)) * std::exp(-lambda * exponent);
          });
        }
      }
      value_[k] = sum;
    }
  }
  double point(double gamma) const {
    const double y = 0.5 - std::sin(std::asin(std::clamp(1 - 2 * gamma / pi, -1.0, 1.0)) / 3), at = y * cells;
    const double i = std::clamp(std::floor(at) - 1, 0.0, static_cast<double>(cells - 3));
    double w[4];
    f64::cubic_weights(at - i, w[0], w[1], w[2], w[3]);
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += w[k] * value_[static_cast<std::size_t>(i) + k];
    return sum;
  }
  double directional(double gamma) const { return f64::phase_value(kind_, g_, std::cos(gamma)) * std::sin(gamma); }

 private:
  static constexpr std::array edges{0.0, 1e-4, 5e-4, 2.5e-3, 0.0125, 0.06, 0.25, 0.5, 0.75, 0.94, 0.9875, 0.9975, 1.0};
  static constexpr std::size_t cells = 192;
  static double gamma_at(double y) { return pi * y * y * (3 - 2 * y); }
  int kind_;
  double g_;
  std::array<double, cells + 1> value_{};
};

// How a lobe about a direction phi away from the light weighs the rays at each gamma: nodes of a quadrature over gamma.
struct Weights {
  std::vector<double> gamma, weight;

  // over(gamma): the lobe, integrated around the light. `breaks` ascending.
  template <class Over>
  void add(const std::vector<double>& breaks, Over&& over) {
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      if (!(breaks[i + 1] > breaks[i])) continue;
      panel(breaks[i], breaks[i + 1], [&](double at, double w) {
        gamma.push_back(at);
        weight.push_back(w * over(at));
      });
    }
  }
};

void sort_breaks(std::vector<double>& breaks, double low, double high) {
  for (const double near : {1e-3, 5e-3, 0.02, 0.08, 0.25, 0.6}) breaks.push_back(near), breaks.push_back(pi - near);
  breaks.push_back(low);
  breaks.push_back(high);
  std::erase_if(breaks, [&](double b) { return b < low || b > high; });
  std::sort(breaks.begin(), breaks.end());
}

Weights lambert_weights(double phi) {
  const double kink = std::fabs(pi / 2 - phi);
  std::vector<double> breaks{kink, pi - kink};
  for (const double step : {0.02, 0.1, 0.3, 0.8}) {
    for (const double at : {kink, pi - kink}) breaks.insert(breaks.end(), {at - step, at + step});
  }
  sort_breaks(breaks, 0, pi);
  Weights weights;
  weights.add(breaks, [&](double gamma) {
    const double a = std::cos(phi) * std::cos(gamma), b = std::sin(phi) * std::sin(gamma);
    if (a >= b) return 2 * pi * a;
    if (a <= -b) return 0.0;
    const double psi = std::acos(-a / b);
    return 2 * (a * psi + b * std::sin(psi));
  });
  return weights;
}

Weights phong_weights(double phi, double shininess) {
  const double exponent = std::max(shininess, 1e-9);
  const double least = std::exp(-35 / exponent), width = std::acos(std::min(least, 1.0));  // beyond, the lobe is below 1e-15
  std::vector<double> breaks{phi};
  for (const double part : {0.08, 0.18, 0.3, 0.45, 0.65, 0.85})
    breaks.insert(breaks.end(), {phi - part * width, phi + part * width});
  const double kink = std::fabs(pi / 2 - phi);
  for (const double step : {0.0, 0.02, 0.1}) {
    for (const double at : {kink, pi - kink}) breaks.insert(breaks.end(), {at - step, at + step});
  }
  sort_breaks(breaks, std::max(0.0, phi - width), std::min(pi, phi + width));
  Weights weights;
  weights.add(breaks, [&](double gamma) {
    const double a = std::cos(phi) * std::cos(gamma), b = std::sin(phi) * std::sin(gamma), top = std::cos(gamma - phi);
    if (top <= least) return 0.0;
    const double psi = b > 0 && (least - a) / b > -1 ? std::acos(std::min((least - a) / b, 1.0)) : pi;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      panel(psi * k / 3, psi * (k + 1) / 3, [&](double at, double w) {
        const double half_sine = std::sin(at / 2), cosine = top - 2 * b * half_sine * half_sine;
        sum += cosine > 0 ? w * std::pow(cosine, exponent) : 0;
      });
    }
    return sum * (exponent + 1) / pi;  // both halves, normalised
  });
  return weights;
}

void fill(std::span<float> table, Rays& rays, bool back, double w, Weights (*weights_at)(double phi, double shininess),
          double shininess) {
  constexpr std::size_t half = m * (n + 1);
  const double last = static_cast<double>(n - 1), last_angle = static_cast<double>(m - 1);
  table[0] = static_cast<float>(n);
  table[1] = static_cast<float>(w);
  table[2] = static_cast<float>(m);
  table[3] = back ? static_cast<float>(4 + half) : 0;
  w = static_cast<double>(table[1]);
  std::vector<Weights> weights;  // of the angles from the light, then of those from the direction away from it
  std::vector<double> flatten;
  for (std::size_t j = 0; j < (back ? 2 * m : m); ++j) {
    const double y = static_cast<double>(j % m) / last_angle, s = w * y / (1 + w - y), angle = 2 * std::asin(std::min(s, 1.0));
    weights.push_back(weights_at(j < m ? angle : pi - angle, shininess));
    flatten.push_back((s + w) / (1 + w));
  }
  const double top = std::pow(100.0 / 130.0, 0.25);
  for (std::size_t i = 0; i <= n; ++i) {
    double lambda = 0;
    if (i < n) {
      const double q = std::pow(top * static_cast<double>(i) / last, 4);
      lambda = 30 * q / (1 - q);
      rays.prepare(lambda);
    }
    for (std::size_t j = 0; j < weights.size(); ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < weights[j].gamma.size(); ++k) {
        const double gamma = weights[j].gamma[k];
        sum += weights[j].weight[k] * (i < n ? rays.point(gamma) : rays.directional(gamma));
      }
      table[4 + j / m * half + i * m + j % m] = static_cast<float>(sum * flatten[j] * (1 + lambda));
    }
  }
}

}  // namespace

std::vector<float> shininess_of(const std::vector<Material>& materials) {
  std::vector<float> found;
  find_shininess(materials, found);
  return found;
}

void find_shininess(const std::vector<Material>& materials, std::vector<float>& found) {
  found.clear();
  for (const Material& material : materials) {
    if (material.specular != glm::vec3(0)) found.push_back(material.shininess);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

std::vector<float> surface_airlight_tables(Phase phase, const std::vector<float>& shininess) {
  Rays rays(phase);
  const bool back = f64::phase_value(static_cast<int>(phase.kind), phase.g, -1.0) >
                    f64::phase_value(static_cast<int>(phase.kind), phase.g, 1.0);
  std::vector<float> tables(surface_airlight_floats * (1 + shininess.size()));
  const auto table = [&](std::size_t k) {
    return std::span(tables).subspan(k * surface_airlight_floats, surface_airlight_floats);
  };
  fill(
      table(0), rays, back, 1, [](double phi, double) { return lambert_weights(phi); }, 0);
  for (std::size_t k = 0; k < shininess.size(); ++k) {
    const auto exponent = static_cast<double>(shininess[k]);
    fill(table(k + 1), rays, back, std::clamp(2.5 / std::sqrt(exponent + 1), 0.35, 1.0), phong_weights, exponent);
  }
  return tables;
}

}  // namespace airlight
