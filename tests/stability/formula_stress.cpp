#include "tests/stability/formula_stress.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "tests/formulas/builds.h"

namespace airlight {

namespace {

using In = std::vector<double>;
using Out = std::vector<double>;

constexpr double pi = 3.14159265358979323846, least = 1.1754944e-38, largest = 3.4028234e38;

double relative(const In&, double truth) { return std::max(std::fabs(truth), 1e-37); }
double absolute(const In&, double) { return 1; }

// The float itself and those around it.
void around(Columns& in, double x) {
  const auto f = static_cast<float>(x);
  for (const float y : {f, std::nextafterf(f, HUGE_VALF), std::nextafterf(f, -HUGE_VALF)}) {
    if (std::isfinite(y)) add_call(in, y);
  }
}
double any_magnitude(Draw& draw) { return draw.magnitude(1e-37, 1e37); }
long double fade(long double tau) { return tau < 87 ? std::exp(-tau) : 0; }
long double opaque(long double tau) { return -std::expm1(-tau); }
// 1 - (1 - exp(-t)) / t without cancellation
long double mean(long double tau) { return tau == 0 ? 1 : opaque(tau) / tau; }

StressedFormula one(std::string name, Formula f, std::string domain, std::function<double(Draw&)> number,
                    std::initializer_list<double> branches, long double (*truth)(long double), std::string scale,
                    double (*scale_of)(const In&, double), std::string_view bound) {
  StressedFormula s;
  s.name = std::move(name), s.formula = f, s.domain = std::move(domain), s.scale = std::move(scale), s.scale_of = scale_of;
  s.bound = bound;
  s.draw = [number](Draw& draw, Columns& in) { add_call(in, number(draw)); };
  s.special = [b = std::vector<double>(branches)](Columns& in) {
    for (const double x : b) around(in, x);
  };
  s.truth = [truth](const In& x) { return Out{static_cast<double>(truth(static_cast<long double>(x[0])))}; };
  return s;
}

void add_elementary(std::vector<StressedFormula>& all) {
  const auto either = [](Draw& d) { return (d.chance(0.5) ? 1 : -1) * d.magnitude(1e-30, 1e3); };
  all.push_back(one(
      "exp_", Formula::exp, "all, held in -87..88", either, {-1e38, -88, -87, -0.34657359, 0, 1e-40, 0.34657359, 87, 88, 1e38},
      [](long double x) { return std::exp(std::clamp(x, -87.0L, 88.0L)); }, "itself", relative, "stress_exp"));
  all.push_back(one(
      "exp2_", Formula::exp2, "-126..0", [](Draw& d) { return -d.magnitude(1e-30, 126); }, {-0.0, -0.5, -1.5, -1, -125.5},
      [](long double x) { return std::exp2(x); }, "itself", relative, "stress_exp"));
  all.push_back(one(
      "log_", Formula::log, "normal, above 0", [](Draw& d) { return d.magnitude(1.2e-38, 3.3e38); },
      {1.41421356, 0.70710678, 1, 2, least * 2}, [](long double x) { return std::log(x); }, "itself", relative, "stress_log"));
  all.push_back(one(
      "erf_", Formula::erf, "all", either, {-1e38, -3.7, -1e-40, 0, 1e-40, 0.5, 1, 3.7, 1e38},
      [](long double x) { return std::erf(x); }, "1", absolute, "erf"));
  all.push_back(one(
      "erf_ small", Formula::erf, "-0.1..0.1", [](Draw& d) { return (d.chance(0.5) ? 1 : -1) * d.magnitude(1e-30, 0.1); },
      {1e-30}, [](long double x) { return std::erf(x); }, "itself", relative, "stress_relative"));
  all.push_back(one(
      "erf_printed (Zhou et al. 2007)", Formula::erf_printed, "all", either, {-2.629639, -1e-40, 0, 2.629639, 1e38},
      [](long double x) { return std::erf(x); }, "1", absolute, "erf_printed"));
  all.push_back(one(
      "atan_", Formula::atan, "0 and above", any_magnitude, {0, 1e-30, 1, largest}, [](long double x) { return std::atan(x); },
      "itself", relative, "stress_relative"));
  for (StressedFormula& s : all) s.rises = s.formula == Formula::erf_printed ? 0 : 1;
}

void add_fades(std::vector<StressedFormula>& all) {
  all.push_back(one(
      "transmittance", Formula::transmittance, "0..1e30", any_magnitude, {0, 1e-40, 87, 1e30},
      [](long double x) { return fade(x); }, "itself, 0 at 1e-37",
      [](const In& in, double t) { return std::max(t * (1 + in[0]), 1e-37); }, "transmittance"));
  all.push_back(one(
      "opacity", Formula::opacity, "0..1e30", any_magnitude, {0, 1e-37, 0.25, 87, 1e30}, [](long double x) { return opaque(x); },
      "itself", relative, "opacity"));
  all.push_back(one(
      "mean_transmittance", Formula::mean_transmittance, "0..1e30", any_magnitude, {0, 1e-37, 0.25, 87, 1e30},
      [](long double x) { return mean(x); }, "itself", relative, "opacity"));
  all.push_back(one(
      "splat_opacity", Formula::splat_opacity, "0..1e30", any_magnitude, {0, 1e-37, 1, 87, 1e30},
      [](long double x) { return opaque(x); }, "itself", relative, "splat_opacity"));
  for (StressedFormula& s : all) {
    if (s.formula == Formula::transmittance || s.formula == Formula::mean_transmittance) s.rises = -1;
    if (s.formula == Formula::opacity || s.formula == Formula::splat_opacity) s.rises = 1;
  }
  StressedFormula length = one("attenuated_length", Formula::attenuated_length, "lengths 0..1e15, extinctions 0..1e6",
                               any_magnitude, {}, nullptr, "itself", relative, "stress_length");
  length.draw = [](Draw& d, Columns& in) { add_call(in, d.magnitude(1e-9, 1e15), d.magnitude(1e-20, 1e6)); };
  length.special = [](Columns& in) {
    for (const double l : {0.0, 1e-9, 1.0, 1e15}) {
      for (const double e : {0.0, 1e-30, 1e-12, 0.25, 1e6}) add_call(in, l, e);
    }
  };
  length.truth = [](const In& x) {
    return Out{x[1] > 0 ? static_cast<double>(-std::expm1(-x[0] * x[1]) / std::max(x[1], 1e-30)) : x[0]};
  };
  length.rises = 1;
  all.push_back(length);
  StressedFormula point = length;
  point.name = "point_irradiance", point.formula = Formula::point_irradiance,
  point.domain = "distances 0..1e9, radii 1e-6..1e6, extinctions 0..1e6";
  point.scale = "itself, times 1 + depth; 0 at 1e-37", point.bound = "unit_distance";
  point.draw = [](Draw& d, Columns& in) {
    add_call(in, d.magnitude(1e-9, 1e9), d.magnitude(1e-6, 1e6), d.magnitude(1e-12, 1e6));
  };
  point.special = [](Columns& in) {
    for (const double r : {1e-6, 1e6}) {
      for (const double e : {0.0, 1e6}) add_call(in, 0, r, e), add_call(in, r, r, e);
    }
  };
  point.truth = [](const In& x) {
    return Out{static_cast<double>(fade(x[0] * x[2])) / (std::max(x[0], x[1]) * std::max(x[0], x[1]))};
  };
  point.scale_of = [](const In& x, double t) { return std::max(t * (1 + x[0] * x[2]), 1e-37); };
  point.rises = -1;
  all.push_back(point);
}

void add_phases(std::vector<StressedFormula>& all) {
  const std::pair<const char*, PhaseKind> kinds[] = {{"rayleigh", PhaseKind::rayleigh},
                                                     {"henyey_greenstein", PhaseKind::henyey_greenstein},
                                                     {"cornette_shanks", PhaseKind::cornette_shanks},
                                                     {"mie_hazy", PhaseKind::mie_hazy},
                                                     {"mie_murky", PhaseKind::mie_murky}};
  for (const auto& [name, kind] : kinds) {
    for (const double g : {-0.99, -0.3, 1e-7, 0.6, 0.99}) {
      if (kind != PhaseKind::henyey_greenstein && kind != PhaseKind::cornette_shanks && g != 0.6) continue;
      StressedFormula s = one(
          std::string("phase ") + name, Formula::phase_value, "mu -1..1",
          [](Draw& d) {
            const double near = d.magnitude(1e-8, 1);  // of an end
            return d.chance(0.5) ? 1 - near : near - 1;
          },
          {-1, -0.9999999, 0, 0.9999999, 1}, nullptr, "itself", relative, "phase_value");
      if (kind == PhaseKind::henyey_greenstein || kind == PhaseKind::cornette_shanks)
        s.name += " g " + std::to_string(g).substr(0, 5);
      s.phase = {kind, as_float(g)};
      s.truth = [kind = kind, g = as_float(g)](const In& x) {
        const long double mu = std::clamp(x[0], -1.0, 1.0), a = g;  // beyond by rounding: the end
        const long double peak = 1 / std::pow(1 + a * a - 2 * a * mu, 1.5L), half = (1 + mu) / 2, p = pi;
        switch (kind) {
          case PhaseKind::rayleigh:
            return Out{static_cast<double>(3 / (16 * p) * (1 + mu * mu))};
          case PhaseKind::henyey_greenstein:
            return Out{static_cast<double>((1 - a * a) / (4 * p) * peak)};
          case PhaseKind::cornette_shanks:
            return Out{static_cast<double>(3 * (1 - a * a) * (1 + mu * mu) / (8 * p * (2 + a * a)) * peak)};
          case PhaseKind::mie_hazy:
            return Out{static_cast<double>((0.5L + 4.5L * std::pow(half, 8.0L)) / (4 * p))};
          default:
            return Out{static_cast<double>((0.5L + 16.5L * std::pow(half, 32.0L)) / (4 * p))};
        }
      };
      all.push_back(s);
    }
  }
  StressedFormula phong = one("phong", Formula::phong, "apart 0..2, shininess 0..1e4", any_magnitude, {}, nullptr,
                              "itself, times 1 + its logarithm", nullptr, "phong");
  phong.draw = [](Draw& d, Columns& in) {
    add_call(in, d.between(0.01, 1), d.magnitude(1e-10, 2), d.chance(0.05) ? 0 : d.magnitude(1e-3, 1e4));
  };
  phong.special = [](Columns& in) {
    for (const double apart : {0.0, 1e-30, 0.99999994, 1.0, 2.0}) {
      for (const double n : {0.0, 1.0, 1e4}) add_call(in, 1, apart, n), add_call(in, 0, apart, n);
    }
  };
  phong.truth = [](const In& x) {
    if (!(x[0] > 0) || !(x[1] < 1)) return Out{0.0};
    return Out{static_cast<double>((static_cast<long double>(x[2]) + 1) / (2 * static_cast<long double>(pi)) *
                                   std::exp(std::max(x[2] * std::log1p(-static_cast<long double>(x[1])), -87.0L)))};
  };
  phong.scale_of = [](const In& x, double t) {
    return std::max(t * (1 + std::min(std::fabs(x[2] * std::log1p(-std::min(x[1], 1 - 1e-12))), 87.0)), 1e-36);
  };
  phong.rises = -1, phong.along = 1;
  all.push_back(phong);
}

void add_gaussians(std::vector<StressedFormula>& all) {
  StressedFormula fall = one("gaussian_falloff", Formula::gaussian_falloff, "radii 1e-6..1e6, distances to 1e9", any_magnitude,
                             {}, nullptr, "itself, times 1 + the exponent", nullptr, "stress_relative");
  fall.draw = [](Draw& d, Columns& in) {
    const double radius = d.magnitude(1e-6, 1e6),
                 distance = d.chance(0.8) ? radius * d.magnitude(1e-3, 8) : d.magnitude(1e-9, 1e9);
    add_call(in, 1 / radius, distance * distance);
  };
  fall.special = [](Columns& in) {
    for (const double r : {1e-6, 1.0, 1e6}) add_call(in, 1 / r, 0), add_call(in, 1 / r, 1e18), add_call(in, 1 / r, 60 * r * r);
  };
  fall.truth = [](const In& x) { return Out{std::exp2(std::max(-x[0] * x[0] * x[1] * 1.4426950408889634, -86.5))}; };
  fall.scale_of = [](const In& x, double t) { return t * (1 + std::min(x[0] * x[0] * x[1], 60.0)); };
  fall.rises = -1, fall.along = 1;
  all.push_back(fall);
  StressedFormula depth = fall;
  depth.name = "gaussian_depth", depth.formula = Formula::gaussian_depth, depth.domain = "radii 1e-6..1e6, places to 1e30",
  depth.scale = "the whole line";
  depth.bound = "gaussian_depth", depth.scale_of = absolute, depth.rises = 1, depth.along = 3;
  const auto call = [](Draw& d, Columns& in) {
    const double radius = d.magnitude(1e-6, 1e6), from = radius * (d.chance(0.5) ? 1 : -1) * d.magnitude(1e-6, 1e3);
    add_call(in, 1 / radius, radius * d.magnitude(1e-6, 30), from, d.chance(0.1) ? 1e30 : from + radius * d.magnitude(1e-6, 1e3));
  };
  depth.draw = call;
  depth.special = [](Columns& in) {
    for (const double r : {1e-6, 1.0, 1e6})
      add_call(in, 1 / r, 0, -1e30, 1e30), add_call(in, 1 / r, 1e9, -r, r), add_call(in, 1 / r, 0, 3.7 * r, 3.8 * r);
  };
  depth.truth = [](const In& x) {
    const long double a = x[0], h = a * x[1], from = a * x[2], to = a * x[3];
    const long double between = from > 0 ? std::erfc(from) - std::erfc(to) : std::erf(to) - std::erf(from);
    return Out{static_cast<double>(0.5L * std::exp(-h * h) * between)};
  };
  all.push_back(depth);
  StressedFormula printed = depth;
  printed.name = "gaussian_depth, printed erf (Zhou et al. 2007)", printed.formula = Formula::gaussian_depth_printed,
  printed.bound = "erf_printed", printed.rises = 0;
  all.push_back(printed);
}

void add_links(std::vector<StressedFormula>& all) {
  StressedFormula links = one("link_shares", Formula::link_shares, "depths 0..1e30, of the whole", any_magnitude, {}, nullptr,
                              "itself", relative, "link_shares");
  links.draw = [](Draw& d, Columns& in) {
    const double whole = d.magnitude(1e-15, 1e10);
    add_call(in, whole * (d.chance(0.3) ? 1 : d.magnitude(1e-2, 1)), whole);
  };
  links.special = [](Columns& in) {
    for (const double t : {0.0, 0.24999999, 0.25, 1e30}) add_call(in, t, t);
    add_call(in, 0, 0), add_call(in, 0, 1);
  };
  links.truth = [](const In& x) {
    const long double all_of = x[1], lost = opaque(all_of), ratio = all_of > 0 ? x[0] / all_of : 1;
    const long double self =
        all_of < 1e-3L ? all_of * all_of * (0.5L - all_of * (1.0L / 6 - all_of * (1.0L / 24 - all_of / 120))) : all_of - lost;
    return Out{static_cast<double>(lost), static_cast<double>(lost * ratio), static_cast<double>(self * ratio * ratio)};
  };
  all.push_back(links);
  StressedFormula scattered = links;
  scattered.name = "environment_scattered", scattered.formula = Formula::environment_scattered,
  scattered.domain = "depths 0..1e10";
  scattered.bound = "stress_length",
  scattered.draw = [](Draw& d, Columns& in) { add_call(in, d.magnitude(1e-15, 1e10), d.magnitude(1e-15, 1e10)); };
  scattered.special = [](Columns& in) { add_call(in, 0, 0), add_call(in, 1, 0), add_call(in, 0, 1), add_call(in, 1e30, 0); };
  scattered.truth = [](const In& x) {
    const long double both = static_cast<long double>(x[0]) + 2 * static_cast<long double>(x[1]), m = mean(both);
    return Out{static_cast<double>(m * x[0]), static_cast<double>(m * x[1])};
  };
  all.push_back(scattered);
}

void add_steps(std::vector<StressedFormula>& all) {
  StressedFormula step =
      one("step_angle, step_means", Formula::step_of_light, "steps to 1e9, lamps to 1e9 beside, 1e-6 to 1e9 away", any_magnitude,
          {}, nullptr, "angle over h: itself; means: the step", nullptr, "stress_step");
  step.draw = [](Draw& d, Columns& in) {
    const double a = d.magnitude(1e-3, 1e3), size = d.magnitude(1e-3, 1e3),
                 foot = d.chance(0.5) ? a + size * d.between(-1, 2) : d.magnitude(1e-3, 1e6);
    add_call(in, a, a + size, foot, d.magnitude(1e-6, 1e6));
  };
  step.special = [](Columns& in) {
    add_call(in, 0, 1, 0.5, 1e-6), add_call(in, 0, 1, 0, 1e-6), add_call(in, 0, 1, 1, 1e-6), add_call(in, 0, 1e9, 5, 1e-6);
  };
  step.truth = [](const In& x) {
    const long double a = static_cast<long double>(x[0]) - x[2], b = static_cast<long double>(x[1]) - x[2], h = x[3];
    const long double angle = std::atan2(h * (b - a), h * h + a * b);
    return Out{static_cast<double>((a * b < -h * h ? std::atan2(b, h) - std::atan2(a, h) : angle) / h)};
  };
  step.scale_of = relative;
  all.push_back(step);
  StressedFormula graded = step;
  graded.name = "graded_step", graded.formula = Formula::graded_step, graded.domain = "lengths to 1e15, extinctions to 1e6",
  graded.scale = "the length or the step";
  graded.bound = "graded_step";
  graded.draw = [](Draw& d, Columns& in) {
    const double n = std::floor(d.magnitude(1, 4096));
    add_call(in, std::floor(n * d.unit()), n, d.magnitude(1e-3, 1e6), d.magnitude(1e-12, 1e4));
  };
  graded.special = [](Columns& in) {
    for (const double n : {1.0, 4096.0})
      add_call(in, 0, n, 1, 1), add_call(in, n, n, 1, 1), add_call(in, n, n, 1e15, 1e6), add_call(in, 1, n, 1, 0);
  };
  graded.truth = [](const In& x) {
    const long double tau = static_cast<long double>(x[2]) * x[3], share = x[0] / static_cast<long double>(x[1]);
    if (tau < 0.02L || x[0] >= x[1]) return Out{static_cast<double>(x[2] * share)};
    return Out{static_cast<double>(std::expm1(share * std::log1p(tau)) / x[3])};
  };
  graded.scale_of = [](const In& x, double) { return x[2]; };
  graded.rises = 1, graded.along = 2;
  all.push_back(graded);
}

}  // namespace

std::string text_of(const In& inputs) {
  std::string all;
  for (const double x : inputs) {
    char one_number[40];
    std::snprintf(one_number, sizeof one_number, "%s%.9g", all.empty() ? "" : ", ", x);
    all += one_number;
  }
  return all;
}

std::vector<StressedFormula> stressed_formulas() {
  std::vector<StressedFormula> all;
  add_elementary(all), add_fades(all), add_phases(all), add_gaussians(all), add_links(all), add_steps(all), add_integrals(all);
  return all;
}

FormulaStress stress(const StressedFormula& f, std::uint32_t stream, std::size_t calls) {
  Calls asked{f.formula, {}, f.phase, f.table};
  f.special(asked.inputs);
  Draw draw(stream);
  const auto drawn = static_cast<std::size_t>(std::ceil(static_cast<double>(calls) * f.share));
  for (std::size_t i = 0; i < drawn; ++i) f.draw(draw, asked.inputs);
  const Columns found = run_float(asked);
  FormulaStress result;
  const std::size_t n = asked.inputs[0].size();
  In inputs(asked.inputs.size());
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < inputs.size(); ++k) inputs[k] = asked.inputs[k][i];
    const Out truth = f.truth(inputs);
    for (std::size_t k = 0; k < truth.size(); ++k) {
      if (!std::isfinite(found[k][i])) ++result.not_finite;
      result.measured.add(std::fabs(found[k][i] - truth[k]) / f.scale_of(inputs, truth[k]), [&] { return text_of(inputs); });
    }
  }
  const auto bits = [](double x) { return std::bit_cast<std::uint32_t>(static_cast<float>(x)); };
  for (const Simd simd : available_simd()) {
    const Columns other = run_simd(asked, simd);
    for (std::size_t i = 0; i < n; ++i) {
      bool same = true;
      for (std::size_t k = 0; k < most_results; ++k) same = same && bits(other[k][i]) == bits(found[k][i]);
      result.other_bits += same ? 0 : 1;
    }
  }
  return result;
}

}  // namespace airlight
