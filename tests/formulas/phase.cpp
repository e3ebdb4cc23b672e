// Phase functions: each integrates to 1 over the sphere, g > 0 scatters forward, float keeps its digits.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "common/formulas/double.h"
#include "tests/formulas/builds.h"
#include "tests/tolerances.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;

std::vector<Phase> phases() {
  std::vector<Phase> all{{PhaseKind::isotropic, 0}, {PhaseKind::rayleigh, 0}, {PhaseKind::mie_hazy, 0}, {PhaseKind::mie_murky, 0}};
  for (const double g : {-0.99, -0.9, -0.5, 0.0, 0.3, 0.6, 0.9, 0.96, 0.99}) {
    all.push_back({PhaseKind::henyey_greenstein, g});
    all.push_back({PhaseKind::cornette_shanks, g});
  }
  return all;
}

double value(Phase p, double mu) { return f64::phase_value(static_cast<int>(p.kind), p.g, mu); }

// mu of the midpoint rule in u, mu = +-(1 - u^3): fine at the peak. `n` points.
struct Sphere {
  std::vector<float> mu;
  std::vector<double> weight;
  Sphere(int n, double g) {
    for (int i = 0; i < n; ++i) {
      const double u = (i + 0.5) / n * std::cbrt(2.0);
      mu.push_back(static_cast<float>((g < 0 ? -1 : 1) * (1 - u * u * u)));
      weight.push_back(2 * pi * 3 * u * u * std::cbrt(2.0) / n);
    }
  }
};

TEST(Phase, IntegratesToOneOverTheSphere) {
  double worst = 0, worst_simd = 0;
  for (const Phase p : phases()) {
    const Sphere sphere(100000, p.g);
    double sum = 0;
    for (std::size_t i = 0; i < sphere.mu.size(); ++i) sum += sphere.weight[i] * value(p, static_cast<double>(sphere.mu[i]));
    EXPECT_NEAR(sum, 1, tolerance("phase_integral")) << static_cast<int>(p.kind) << " g " << p.g;
    worst = std::max(worst, std::fabs(sum - 1));
    for (const Simd simd : available_simd()) {
      const std::vector<float> values = phase_value_simd(p, sphere.mu, simd);
      double in_float = 0;
      for (std::size_t i = 0; i < values.size(); ++i) in_float += sphere.weight[i] * static_cast<double>(values[i]);
      EXPECT_NEAR(in_float, 1, tolerance("phase_integral")) << name_of(simd);
      worst_simd = std::max(worst_simd, std::fabs(in_float - 1));
    }
  }
  std::printf("phase functions: largest |integral - 1| %.3g in double, %.3g in float\n", worst, worst_simd);
}

TEST(Phase, MeanCosineIsG) {
  for (const double g : {-0.9, -0.3, 0.4, 0.95}) {
    const Phase p{PhaseKind::henyey_greenstein, g};
    const Sphere sphere(100000, g);
    double mean = 0;
    for (std::size_t i = 0; i < sphere.mu.size(); ++i) {
      const auto mu = static_cast<double>(sphere.mu[i]);
      mean += sphere.weight[i] * value(p, mu) * mu;
    }
    EXPECT_NEAR(mean, g, 1e-5);
  }
  EXPECT_GT(value({PhaseKind::henyey_greenstein, 0.5}, 1), value({PhaseKind::henyey_greenstein, 0.5}, -1));
  EXPECT_GT(value({PhaseKind::cornette_shanks, 0.5}, 1), value({PhaseKind::cornette_shanks, 0.5}, -1));
}

TEST(Phase, FloatKeepsItsDigitsAtThePeak) {
  double worst = 0;
  std::vector<float> mu;
  for (int i = 0; i <= 4000; ++i) mu.push_back(static_cast<float>(i - 2000) / 2000);
  for (const Phase p : phases()) {
    const std::vector<float> found = phase_value_simd(p, mu, available_simd().back());
    for (std::size_t i = 0; i < mu.size(); ++i) {
      const double truth = value(p, static_cast<double>(mu[i]));
      const double error = std::fabs(static_cast<double>(found[i]) / truth - 1);
      worst = std::max(worst, error);
      EXPECT_FALSE(!(error <= tolerance("phase_value"))) << "kind " << static_cast<int>(p.kind) << " g " << p.g << " mu " << mu[i];
    }
    for (const Simd simd : available_simd()) EXPECT_EQ(phase_value_simd(p, mu, simd), found) << name_of(simd);
  }
  std::printf("phase functions in float: relative error at most %.3g\n", worst);
}

}  // namespace

}  // namespace airlight
