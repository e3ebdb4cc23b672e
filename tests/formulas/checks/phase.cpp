// Phase functions: the published formulas, the integral over the sphere, the mean cosine.
#include <numbers>

#include "tests/formulas/checks/random.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;

std::vector<Phase> phases() {
  std::vector<Phase> all{
      {PhaseKind::isotropic, 0}, {PhaseKind::rayleigh, 0}, {PhaseKind::mie_hazy, 0}, {PhaseKind::mie_murky, 0}};
  for (const double g : {-0.99, -0.9, -0.5, 0.0, 0.3, 0.6, 0.9, 0.96, 0.99}) {
    all.push_back({PhaseKind::henyey_greenstein, g});
    all.push_back({PhaseKind::cornette_shanks, g});
  }
  return all;
}

std::string place_of(Phase phase, double mu) {
  return place({{"kind", static_cast<double>(phase.kind)}, {"g", phase.g}, {"mu", mu}});
}

// As published; g > 0 forward, mu = 1 straight on.
double published(Phase phase, double mu_double) {
  const long double g = phase.g, mu = mu_double, four_pi = 4 * std::numbers::pi_v<long double>;
  const auto peak = [&] { return 1 / std::pow(1 + g * g - 2 * g * mu, 1.5L); };
  long double value = 1 / four_pi;
  if (phase.kind == PhaseKind::rayleigh) value = 0.75L * (1 + mu * mu) / four_pi;
  if (phase.kind == PhaseKind::henyey_greenstein) value = (1 - g * g) * peak() / four_pi;
  if (phase.kind == PhaseKind::cornette_shanks) value = 1.5L * (1 - g * g) / (2 + g * g) * (1 + mu * mu) * peak() / four_pi;
  if (phase.kind == PhaseKind::mie_hazy) value = (0.5L + 4.5L * std::pow((1 + mu) / 2, 8.0L)) / four_pi;
  if (phase.kind == PhaseKind::mie_murky) value = (0.5L + 16.5L * std::pow((1 + mu) / 2, 32.0L)) / four_pi;
  return static_cast<double>(value);
}

Measured measure_value(const Run& run) {
  Columns in(1);
  for (int i = 0; i <= 4000; ++i) in[0].push_back(as_float((i - 2000) / 2000.0));
  Measured m;
  for (const Phase phase : phases()) {
    const Columns found = run({Formula::phase_value, in, phase});
    for (std::size_t i = 0; i < in[0].size(); ++i) {
      m.add(relative_error(found[0][i], published(phase, in[0][i])), [&] { return place_of(phase, in[0][i]); });
    }
  }
  return m;
}

// The midpoint rule in u, mu = +-(1 - u^3): fine at the peak.
struct Sphere {
  Columns mu{std::vector<double>()};
  std::vector<double> weight;
  Sphere(int n, double g) {
    for (int i = 0; i < n; ++i) {
      const double u = (i + 0.5) / n * std::cbrt(2.0);
      mu[0].push_back(as_float((g < 0 ? -1 : 1) * (1 - u * u * u)));
      weight.push_back(2 * pi * 3 * u * u * std::cbrt(2.0) / n);
    }
  }
};

Measured measure_integral(const Run& run) {
  Measured m;
  for (const Phase phase : phases()) {
    const Sphere sphere(100000, phase.g);
    const Columns found = run({Formula::phase_value, sphere.mu, phase});
    double sum = 0;
    for (std::size_t i = 0; i < sphere.weight.size(); ++i) sum += sphere.weight[i] * found[0][i];
    m.add(std::fabs(sum - 1), [&] { return place_of(phase, 0); });
  }
  return m;
}

// That of Henyey and Greenstein is g; that of Cornette and Shanks 3 g (4 + g^2) / (5 (2 + g^2)).
Measured measure_mean_cosine(const Run& run) {
  Measured m;
  for (const Phase phase : phases()) {
    const Sphere sphere(100000, phase.g);
    const Columns found = run({Formula::phase_value, sphere.mu, phase});
    double mean = 0;
    for (std::size_t i = 0; i < sphere.weight.size(); ++i) mean += sphere.weight[i] * found[0][i] * sphere.mu[0][i];
    double truth = 0;
    if (phase.kind == PhaseKind::henyey_greenstein) truth = phase.g;
    if (phase.kind == PhaseKind::cornette_shanks) truth = 3 * phase.g * (4 + phase.g * phase.g) / (5 * (2 + phase.g * phase.g));
    if (phase.kind == PhaseKind::mie_hazy || phase.kind == PhaseKind::mie_murky) {
      // int mu ((1 + mu) / 2)^n dmu over -1..1 is 2 n / ((n + 1) (n + 2)).
      const double n = phase.kind == PhaseKind::mie_hazy ? 8 : 32, height = phase.kind == PhaseKind::mie_hazy ? 4.5 : 16.5;
      truth = height * n / ((n + 1) * (n + 2));
    }
    m.add(std::fabs(mean - truth), [&] { return place_of(phase, 0); });
  }
  return m;
}

}  // namespace

void add_phase_checks(std::vector<Check>& checks) {
  checks.push_back({"phase_value", measure_value, "phase_double", "phase_value"});
  checks.push_back({"phase_integral", measure_integral, "phase_integral", "phase_integral"});
  checks.push_back({"phase_mean_cosine", measure_mean_cosine, "phase_integral", "phase_integral"});
}

}  // namespace airlight
