// Formulas whose truth is an integral: airlight of lamps along rays and on surfaces, mean depths of Gaussians; beside an adaptive
// quadrature in double that shares no table and no boundary function with them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/formulas/double.h"
#include "common/plan/airlight_tables.h"
#include "common/plan/surface_airlight_tables.h"
#include "tests/formulas/checks/sphere.h"
#include "tests/stability/formula_stress.h"

namespace airlight {

namespace {

using In = std::vector<double>;
constexpr double pi = std::numbers::pi;

template <class F>
double panel(F&& f, double a, double b) {
  const double middle = (a + b) / 2, reach = (b - a) / 2;
  double sum = 0;
  for (std::size_t k = 0; k < gauss_node.size(); ++k)
    sum += gauss_weight[k] * (f(middle - reach * gauss_node[k]) + f(middle + reach * gauss_node[k]));
  return sum * reach;
}

// A panel against two halves of it, until they agree to `relative` of themselves or to `enough`.
template <class F>
double adapt(F&& f, double a, double b, double whole, double relative, double enough, int depth = 0) {
  const double middle = (a + b) / 2, left = panel(f, a, middle), right = panel(f, middle, b), both = left + right;
  if (depth > 30 || std::fabs(both - whole) <= std::max(relative * std::fabs(both), enough)) return both;
  return adapt(f, a, middle, left, relative, enough, depth + 1) + adapt(f, middle, b, right, relative, enough, depth + 1);
}

template <class F>
double integral(F&& f, double a, double b, int panels, double relative) {
  std::vector<double> rough;
  double sum = 0;
  const auto end = [&](int k) { return a + (b - a) * k / panels; };
  for (int k = 0; k < panels; ++k) sum += rough.emplace_back(panel(f, end(k), end(k + 1)));
  const double enough = relative * 0.1 * std::fabs(sum);
  sum = 0;
  for (int k = 0; k < panels; ++k) sum += adapt(f, end(k), end(k + 1), rough[static_cast<std::size_t>(k)], relative, enough);
  return sum;
}

// int_a^b f, 0 <= a <= b, of a bounded f that may change at any scale above 0: over the logarithm, down to 1e-11 of b.
template <class F>
double scaled_integral(F&& f, double a, double b, double relative) {
  if (!(b > a)) return 0;
  const double from = std::log(std::max(a, b * 1e-11)), to = std::log(b);
  return integral(
      [&](double u) {
        const double x = std::exp(u);
        return f(x) * x;
      },
      from, to, std::max(1, static_cast<int>((to - from) / 2)), relative);
}

// Over the angle at the lamp between the ray and what it sends there, from the end of the ray that is the nearer: neither x + r
// nor a small angle loses digits.
double ray_airlight(Phase phase, double sigma, double foot, double h, double x0, double x1) {
  const int kind = static_cast<int>(phase.kind);
  const double g = phase.g, turn = std::clamp(foot, x0, x1);
  const double after = scaled_integral(
      [&](double s) { return f64::phase_value(kind, g, -std::cos(s)) * std::exp(-sigma * (foot + h / std::tan(s / 2))); },
      x1 >= 1e15 ? 0 : std::atan2(h, x1 - foot), std::atan2(h, turn - foot), 1e-9);
  const double before = scaled_integral(
      [&](double s) { return f64::phase_value(kind, g, std::cos(s)) * std::exp(-sigma * (foot + h * std::tan(s / 2))); },
      std::atan2(h, foot - x0), std::atan2(h, foot - turn), 1e-9);
  return sigma / h * ((x1 > turn ? after : 0) + (turn > x0 ? before : 0));
}

// What is known of a difference of two boundary values: the value and the smaller of the two pairs that it can be told by.
double known_of(Phase phase, const In& x, double truth) {
  const double sigma = x[0], foot = x[1], h = x[2], x0 = x[3], x1 = x[4];
  const double least = 1e-36 * (1 + sigma / h);
  if (x1 - x0 < 0.4 * std::hypot(foot - x0, h)) return std::max(truth, least);
  const double from = ray_airlight(phase, sigma, foot, h, x0, 1e30);
  const double behind = x1 < foot ? ray_airlight(phase, sigma, foot, h, -1e6 * std::hypot(foot - x0, h), x0) : HUGE_VAL;
  return std::max(truth + std::min(from, behind), least);
}

void add_rays(std::vector<StressedFormula>& all) {
  const std::pair<const char*, Phase> phases[] = {{"isotropic", {}},
                                                  {"g 0.6", {PhaseKind::henyey_greenstein, 0.6F}},
                                                  {"g -0.9", {PhaseKind::henyey_greenstein, -0.9F}},
                                                  {"g 0.99", {PhaseKind::henyey_greenstein, 0.99F}},
                                                  {"murky", {PhaseKind::mie_murky, 0}}};
  for (const auto& [name, phase] : phases) {
    StressedFormula s;
    s.name = std::string("point_airlight, ") + name, s.formula = Formula::point_airlight, s.phase = phase;
    s.domain = "lamps 1e-6..1e6 away, depths 1e-9..20, lengths 1e-5..1e4 times that, or infinite";
    s.scale = "the value and what comes from one end on";
    s.table = airlight_tables(phase, 64), s.share = 0.01;
    s.bound = phase.g > 0.97F ? "stress_airlight_peak" : "airlight_interpolation";
    s.draw = [](Draw& d, Columns& in) {
      const double l = d.magnitude(1e-5, 1e6), x0 = d.chance(0.5) ? 0 : l * d.magnitude(1e-3, 10);
      const double sigma = d.magnitude(1e-9, 20) / (l + x0);  // beyond, eight nodes on a short stretch are too few
      const double angle = d.chance(0.5) ? d.between(0, pi) : pi * d.magnitude(1e-6, 1), h = std::max(l * std::sin(angle), 1e-6);
      const double foot = l * std::cos(angle);
      const double r = std::hypot(as_float(foot) - as_float(x0), h);
      add_call(in, sigma, foot, h, x0, d.chance(0.2) ? 1e30 : as_float(x0) + std::max(r, 1e-2 * x0) * d.magnitude(1e-5, 1e4));
    };
    // Where one way of telling it takes over from another: a stretch of 0.4 r, its end at the foot, a start there, the lit depth.
    s.special = [](Columns& in) {
      for (const double sigma : {1e-6, 0.1, 10.0}) {
        for (const double end : {0.39999998, 0.4, 0.40000004, 0.99999994, 1.0, 1.0000001})
          add_call(in, sigma, 1, 1e-3, 0, end), add_call(in, sigma, end, 1, 0, 1), add_call(in, sigma, end, 1, 1, 3);
      }
      add_call(in, 43.4, 1, 1e-3, 0, 1e30), add_call(in, 43.6, 1, 1e-3, 0, 1e30), add_call(in, 0, 1, 1, 0, 1e30);
    };
    s.truth = [phase = phase](const In& x) { return In{ray_airlight(phase, x[0], x[1], x[2], x[3], x[4])}; };
    s.scale_of = [phase = phase](const In& x, double truth) { return known_of(phase, x, truth); };
    all.push_back(std::move(s));
  }
}

// int over the azimuth of the cosine's positive part, by the angle `apart` of the axis and the light and `turn` of ray and light.
double lambert_about(double apart, double turn) {
  const double a = std::cos(apart) * std::cos(turn), b = std::sin(apart) * std::sin(turn);
  if (a >= b) return 2 * pi * a;
  if (a <= -b) return 0;
  const double half = std::acos(-a / b);
  return 2 * (a * half + b * std::sin(half));
}

// The same of its n-th power, as a normalised lobe.
double phong_about(double n, double apart, double turn) {
  const double a = std::cos(apart) * std::cos(turn), b = std::sin(apart) * std::sin(turn);
  const double half = a >= b ? pi : a <= -b ? 0 : std::acos(-a / b);
  if (half == 0) return 0;
  const auto power = [&](double azimuth) { return std::pow(std::max(a + b * std::cos(azimuth), 0.0), n); };
  return (n + 1) / pi * integral(power, 0, half, 2, 1e-7);
}

// As common/formulas/surface_airlight.h tells it: rays by their angle from the light, then along each.
double surface_truth(double n, double lambda, double s) {
  const double apart = 2 * std::asin(s);
  const auto ray = [&](double turn) {
    const double shape = n > 0 ? phong_about(n, apart, turn) : lambert_about(apart, turn);
    if (shape == 0) return 0.0;
    const double sine = std::sin(turn), beside = 2 * std::sin(turn / 2) * std::sin(turn / 2);
    return shape / (4 * pi) *
           scaled_integral([&](double a) { return std::exp(-lambda * (sine / std::tan(a / 2) - beside)); }, 0, pi - turn, 1e-7);
  };
  // Kinks where the horizon of the axis meets the cone of such rays.
  const double near = std::fabs(pi / 2 - apart), far = std::min(pi / 2 + apart, 3 * pi / 2 - apart);
  return lambda * std::exp(-lambda) *
         (integral(ray, 0, near, 3, 1e-6) + integral(ray, near, far, 3, 1e-6) + (far < pi ? integral(ray, far, pi, 2, 1e-6) : 0));
}

void add_surfaces(std::vector<StressedFormula>& all) {
  for (const double n : {0.0, 20.0}) {
    StressedFormula s;
    s.name = n > 0 ? "surface_airlight_point, Phong 20" : "surface_airlight_point, Lambert",
    s.formula = Formula::surface_airlight;
    s.domain = "depths 1e-9..80, all angles", s.scale = "itself, times 1 + depth", s.bound = "stress_surface_airlight",
    s.share = 0.002;
    const std::vector<float> tables = surface_airlight_tables({}, {20});
    const auto begin = tables.begin() + (n > 0 ? surface_airlight_floats : 0);
    s.table.assign(begin, begin + surface_airlight_floats);
    s.draw = [](Draw& d, Columns& in) { add_call(in, d.magnitude(1e-9, 80), d.chance(0.5) ? d.unit() : d.between(0.69, 0.72)); };
    s.special = [](Columns& in) {
      for (const double depth : {1e-9, 1.0, 80.0})
        add_call(in, depth, 0), add_call(in, depth, 1), add_call(in, depth, 0.70710678);
    };
    s.truth = [n](const In& x) { return In{surface_truth(n, x[0], x[1])}; };
    s.scale_of = [](const In& x, double truth) { return truth * (1 + x[0]); };
    all.push_back(std::move(s));
  }
}

// exp(-u^2) int_0^1 exp(u^2 t^2) dt, by u^2; far away its asymptotic series.
double mean_depth(double squared) {
  const double w = 1 / (2 * squared);
  if (squared > 500) return std::sqrt(pi) / 2 * w * (1 + w * (1 + w * (3 + w * (15 + w * 105))));
  return std::sqrt(pi) / 2 * integral([&](double t) { return std::exp(squared * (t - 1) * (t + 1)); }, 0, 1, 4, 1e-12);
}

void add_depths(std::vector<StressedFormula>& all) {
  StressedFormula s;
  s.name = "average_gaussian_depth", s.formula = Formula::average_gaussian_depth, s.domain = "squared distances 0..1e30";
  s.scale = "itself", s.bound = "average_gaussian_depth", s.share = 0.2, s.rises = -1;
  s.draw = [](Draw& d, Columns& in) { add_call(in, d.chance(0.5) ? d.magnitude(1e-2, 1e2) : d.magnitude(1e-30, 1e30)); };
  s.special = [](Columns& in) { add_call(in, 0), add_call(in, 1e-37), add_call(in, 7), add_call(in, 1e30); };
  s.truth = [](const In& x) { return In{mean_depth(x[0])}; };
  s.scale_of = [](const In&, double truth) { return truth; };
  all.push_back(std::move(s));
}

// What a place scatters of a lamp and of the sun behind more than fog: what Gaussian techniques integrate.
void add_densities(std::vector<StressedFormula>& all) {
  StressedFormula s;
  s.name = "light_density", s.formula = Formula::light_density, s.bound = "light_density";
  s.domain = "lamps 1e-6..1e6 beside, 1e6 along, extinctions to 1e3, depths to 80",
  s.scale = "itself, times 1 + depth; 0 at 1e-37";
  s.draw = [](Draw& d, Columns& in) {
    const double foot = (d.chance(0.5) ? 1 : -1) * d.magnitude(1e-6, 1e6), h = d.magnitude(1e-6, 1e6), x = d.magnitude(1e-6, 1e6);
    add_call(in, std::min(d.magnitude(1e-12, 1e3), 20 / (x + std::hypot(foot, h))), foot, h, x, d.magnitude(1e-9, 40), 1);
  };
  s.special = [](Columns& in) { add_call(in, 0, 0, 1e-6, 0, 0, 1), add_call(in, 1e3, -1e6, 1e6, 1e6, 1e30, 1); };
  s.truth = [](const In& x) {
    const double r = std::hypot(x[3] - x[1], x[2]);
    return In{std::exp(-x[0] * (x[3] + r) - x[4]) / (4 * pi * r * r), std::exp(-x[0] * x[3] - x[4]) / (4 * pi)};
  };
  s.scale_of = [](const In& x, double truth) {
    const double r = std::hypot(x[3] - x[1], x[2]);
    return std::max(truth * (1 + x[0] * (x[3] + r) + x[4]), 1e-37 * (1 + 1 / (r * r)));
  };
  all.push_back(std::move(s));
}

}  // namespace

void add_integrals(std::vector<StressedFormula>& all) { add_rays(all), add_surfaces(all), add_depths(all), add_densities(all); }

}  // namespace airlight
