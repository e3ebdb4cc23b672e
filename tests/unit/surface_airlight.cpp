// Indirect single scattering on surfaces: the tables against high-precision values and, for phase functions without such, against
// a quadrature over the sphere of directions that knows neither the tables nor what they are made from.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "common/formulas/double.h"
#include "common/plan/surface_airlight_tables.h"
#include "common/reference/indirect.h"
#include "tests/formulas/airlight_truth.h"
#include "tests/formulas/rows.h"
#include "tests/parity/inputs.h"
#include "tests/tolerances.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;

std::vector<std::vector<double>> rows(const std::string& name) {
  std::vector<std::vector<double>> all;
  for (const auto& fields : csv_rows("reference/" + name)) {
    all.emplace_back();
    for (const std::string& field : fields) all.back().push_back(number(field));
  }
  return all;
}

double lobe_norm(double n) { return (n + 1) / (2 * pi); }

TEST(SurfaceAirlight, LambertTableHoldsThePreciseValues) {
  const std::vector<float> tables = surface_airlight_tables({PhaseKind::isotropic, 0}, {});
  double worst = 0;
  for (const auto& row : rows("surface_airlight_lambert.csv")) {
    const double found = f64::surface_airlight_point(tables.data(), row[0], std::sin(row[1] / 2));
    worst = std::max(worst, std::fabs(found / row[2] - 1));
  }
  std::printf("Lambert: relative error at most %.2g\n", worst);
  EXPECT_FALSE(!(worst <= tolerance("surface_airlight")));
}

TEST(SurfaceAirlight, PhongTablesHoldThePreciseValues) {
  std::map<double, double> worst;
  std::map<double, std::vector<float>> tables;
  double seconds = 0;
  for (const auto& row : rows("surface_airlight_phong.csv")) {
    const double n = row[2];
    if (!tables.contains(n)) {
      const auto start = std::chrono::steady_clock::now();
      tables[n] = surface_airlight_tables({PhaseKind::isotropic, 0}, {static_cast<float>(n)});
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    const double found = f64::surface_airlight_point(tables[n].data() + surface_airlight_floats, row[0], std::sin(row[1] / 2));
    worst[n] = std::max(worst[n], std::fabs(found / lobe_norm(n) / row[3] - 1));
  }
  for (const auto& [n, error] : worst) {
    std::printf("Phong, shininess %g: relative error at most %.2g\n", n, error);
    EXPECT_FALSE(!(error <= tolerance("surface_airlight"))) << n;
  }
  std::printf("%.0f ms for both tables of one exponent\n", 1e3 * seconds / static_cast<double>(tables.size()));
}

// In polar coordinates about the light, where the sine takes the pole of the rays away: midpoints, fine at the light, of rays by
// the oracle of the airlight, and of the lobe.
class BySphere {
 public:
  BySphere(Phase phase, double lambda, bool directional) {
    for (int i = 0; i < nodes; ++i) {
      const double y = (i + 0.5) / nodes, gamma = pi * y * y * (3 - 2 * y), weight = 6 * pi * y * (1 - y) / nodes;
      const double ray = directional ? f64::phase_value(static_cast<int>(phase.kind), phase.g, std::cos(gamma))
                                     : airlight_truth(phase, lambda, std::cos(gamma), std::sin(gamma), 0, 1e30);
      ray_[static_cast<std::size_t>(i)] = {gamma, ray * std::sin(gamma) * weight};
    }
  }
  // shininess < 0: the cosine of a hemisphere; else the normalised lobe.
  double over(double phi, double shininess) const {
    constexpr int azimuths = 600;
    double sum = 0;
    for (const auto& [gamma, ray] : ray_) {
      for (int j = 0; j < azimuths; ++j) {
        const double cosine =
            std::cos(phi) * std::cos(gamma) + std::sin(phi) * std::sin(gamma) * std::cos(pi * (j + 0.5) / azimuths);
        if (cosine > 0)
          sum += ray * (shininess < 0 ? cosine : lobe_norm(shininess) * std::pow(cosine, shininess)) * 2 * pi / azimuths;
      }
    }
    return sum;
  }

 private:
  static constexpr int nodes = 500;
  std::array<std::pair<double, double>, nodes> ray_;
};

TEST(SurfaceAirlight, TheReferenceHoldsThePreciseValues) {
  double worst = 0;
  for (const auto& row : rows("surface_airlight_lambert.csv")) {
    worst = std::max(worst, std::fabs(indirect_lobe({PhaseKind::isotropic, 0}, false, row[0], row[1], 1) / row[2] - 1));
  }
  std::printf("Lambert: relative error at most %.2g\n", worst);
  EXPECT_FALSE(!(worst <= tolerance("surface_airlight_double")));
  worst = 0;
  for (const auto& row : rows("surface_airlight_phong.csv")) {
    worst = std::max(worst, std::fabs(indirect_lobe({PhaseKind::isotropic, 0}, false, row[0], row[1], row[2]) / row[3] - 1));
  }
  std::printf("Phong: relative error at most %.2g\n", worst);
  EXPECT_FALSE(!(worst <= tolerance("surface_airlight_double")));
}

TEST(SurfaceAirlight, OtherPhaseFunctionsAgreeWithQuadrature) {
  const Phase phases[] = {{PhaseKind::isotropic, 0},
                          {PhaseKind::rayleigh, 0},
                          {PhaseKind::henyey_greenstein, 0.6},
                          {PhaseKind::cornette_shanks, -0.4},
                          {PhaseKind::henyey_greenstein, -0.8},
                          {PhaseKind::mie_hazy, 0}};
  for (const Phase& phase : phases) {
    const std::vector<float> exponents{1, 20, 1000}, tables = surface_airlight_tables(phase, exponents);
    double worst = 0;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const double lambda = std::pow(10, 2 * uniform(61, i) - 1.5);
      for (const bool directional : {false, true}) {
        const BySphere sphere(phase, lambda, directional);
        for (std::size_t k = 0; k <= exponents.size(); ++k) {
          const double phi = 0.05 + 3.04 * uniform(62, i * 7 + static_cast<std::uint32_t>(k));
          const double n = k == 0 ? -1 : static_cast<double>(exponents[k - 1]);
          const float* table = tables.data() + surface_airlight_floats * k;
          const double truth = sphere.over(phi, n);
          const double found = directional ? f64::surface_airlight_directional(table, std::sin(phi / 2))
                                           : f64::surface_airlight_point(table, lambda, std::sin(phi / 2));
          worst = std::max(worst, std::fabs(found / truth - 1));
        }
      }
    }
    std::printf("phase %d, g %.1f: relative error at most %.2g\n", static_cast<int>(phase.kind), phase.g, worst);
    EXPECT_FALSE(!(worst <= tolerance("surface_airlight_quadrature")));
  }
}

// Of lobes that look away from the light, where what scatters back arrives from a small spot.
TEST(SurfaceAirlight, LobesSeeWhatScattersBack) {
  const std::vector<float> exponents{20, 1000, 10000};
  for (const double g : {-0.5, -0.9}) {
    const Phase phase{PhaseKind::henyey_greenstein, g};
    const std::vector<float> tables = surface_airlight_tables(phase, exponents);
    double worst = 0;
    for (std::size_t k = 0; k < exponents.size(); ++k) {
      const auto n = static_cast<double>(exponents[k]);
      const float* table = tables.data() + surface_airlight_floats * (k + 1);
      for (const double lambda : {0.03, 0.4, 5.0}) {
        for (const double behind : {0.0, 0.003, 0.02, 0.1, 0.4, 1.2}) {
          const double phi = pi - behind, s = std::sin(phi / 2);
          const double point = f64::surface_airlight_point(table, lambda, s) / lobe_norm(n);
          const double sun = f64::surface_airlight_directional(table, s) / lobe_norm(n);
          worst = std::max(worst, std::fabs(point / indirect_lobe(phase, false, lambda, phi, n) - 1));
          worst = std::max(worst, std::fabs(sun / indirect_lobe(phase, true, lambda, phi, n) - 1));
        }
      }
    }
    std::printf("g %.1f: relative error at most %.2g\n", g, worst);
    EXPECT_FALSE(!(worst <= tolerance("surface_airlight_quadrature")));
  }
}

}  // namespace

}  // namespace airlight
