// Single scattering along a ray in every build, against the high-precision table and, densely, against the defining integral.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/formulas/double.h"
#include "common/plan/airlight_tables.h"
#include "tests/formulas/airlight_truth.h"
#include "tests/formulas/builds.h"
#include "tests/formulas/rows.h"
#include "tests/parity/inputs.h"
#include "tests/tolerances.h"

namespace airlight {

namespace {

constexpr int default_nodes = 64;

// What a difference of end values can be known to: sigma_t times the larger of B at the start and B' at the end.
double end_value(const std::vector<float>& tables, const AirlightRow& row) {
  double end = f64::airlight_beyond(tables.data(), row.extinction, row.foot, row.h, 0);
  if (row.foot > 0) {
    end = std::max(end, f64::airlight_before(tables.data(), row.extinction, row.foot, row.h, std::min(row.length, row.foot)));
  }
  return row.extinction * end;
}

// The error as a multiple of what is allowed.
double excess(double found, const AirlightRow& row, double end) {
  const double allowed = std::fabs(row.value) < 1e-30
                             ? 1e-30
                             : tolerance("airlight_value") * std::fabs(row.value) + tolerance("airlight_end") * end;
  return std::fabs(found - row.value) / allowed;
}

TEST(Airlight, OracleAgreesWithTheTable) {
  double worst = 0;
  for (const AirlightRow& row : airlight_rows()) {
    const double found = airlight_truth(row.phase, row.extinction, row.foot, row.h, 0, row.length);
    if (row.value < 1e-30) {
      EXPECT_LE(std::fabs(found - row.value), 1e-30);
      continue;
    }
    const double error = std::fabs(found / row.value - 1);
    EXPECT_FALSE(!(error <= tolerance("airlight_double"))) << "k " << row.extinction << " foot " << row.foot << " h " << row.h;
    worst = std::max(worst, error);
  }
  std::printf("oracle: largest relative error %.3g on %zu rows\n", worst, airlight_rows().size());
}

TEST(Airlight, FloatAndSimdAgreeWithTheTable) {
  ASSERT_EQ(airlight_rows().size(), 240U);
  double worst_double = 0, worst_float = 0;
  for (const AirlightRow& row : airlight_rows()) {
    const std::vector<float> tables = airlight_tables(row.phase, default_nodes);
    const double end = end_value(tables, row);
    const double in_double = f64::point_airlight(tables.data(), static_cast<int>(row.phase.kind),
                                                 row.phase.g, row.extinction, row.foot, row.h, 0, row.length);
    const auto f = [](double x) { return std::vector{static_cast<float>(x)}; };
    const PointAirlightInputs in{f(row.extinction), f(row.foot), f(row.h), f(0), f(row.length)};
    const std::vector<float> in_float = point_airlight_float(row.phase, tables, in);
    worst_double = std::max(worst_double, excess(in_double, row, end));
    worst_float = std::max(worst_float, excess(static_cast<double>(in_float[0]), row, end));
    EXPECT_FALSE(!(excess(in_double, row, end) <= 1)) << "k " << row.extinction << " foot " << row.foot << " h " << row.h;
    EXPECT_FALSE(!(excess(static_cast<double>(in_float[0]), row, end) <= 1))
        << "k " << row.extinction << " foot " << row.foot << " h " << row.h;
    for (const Simd simd : available_simd()) {
      EXPECT_EQ(point_airlight_simd(row.phase, tables, in, simd), in_float) << name_of(simd);
    }
  }
  std::printf("of what is allowed (2e-5 value + 1e-7 end value): tables in double %.3f, float %.3f\n", worst_double, worst_float);
}

// Rays of all kinds: the light ahead, beside and behind, optical depths from 1e-4 to 60, short and infinite.
struct RandomRays {
  PointAirlightInputs in;
  explicit RandomRays(std::uint32_t n) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const double extinction = std::pow(10, 4 * uniform(1, i) - 3), l = std::pow(10, 3 * uniform(2, i) - 2);
      const double angle = uniform(3, i) < 0.5 ? std::acos(2 * uniform(4, i) - 1) : std::pow(10, -3 * uniform(4, i)) * 3.1;
      const double length = uniform(5, i) < 0.2 ? 1e30 : l * std::pow(10, 4 * uniform(6, i) - 2);
      in.extinction.push_back(static_cast<float>(std::min(extinction, 20 / l)));
      in.foot.push_back(static_cast<float>(l * std::cos(angle)));
      in.h.push_back(static_cast<float>(std::max(l * std::sin(angle), 1e-3)));
      in.x0.push_back(0);
      in.x1.push_back(static_cast<float>(length));
    }
  }
};

class AirlightPhase : public testing::TestWithParam<Phase> {};

TEST_P(AirlightPhase, TablesAgreeWithTheDefiningIntegral) {
  const Phase phase = GetParam();
  const std::vector<float> tables = airlight_tables(phase, default_nodes);
  const RandomRays rays(4000);
  const std::vector<float> found = point_airlight_simd(phase, tables, rays.in, available_simd().back());
  double worst = 0, square = 0, worst_value = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto at = [&](const std::vector<float>& v) { return static_cast<double>(v[i]); };
    const AirlightRow row{phase, at(rays.in.extinction), at(rays.in.foot), at(rays.in.h), at(rays.in.x1), 0};
    const double truth = airlight_truth(phase, row.extinction, row.foot, row.h, 0, row.length);
    const double error = std::fabs(static_cast<double>(found[i]) - truth);
    const double allowed = tolerance(std::fabs(phase.g) > 0.97 ? "airlight_interpolation_peak" : "airlight_interpolation") *
                               (truth + end_value(tables, row)) + 1e-30;
    EXPECT_FALSE(!(error <= allowed)) << "k " << row.extinction << " foot " << row.foot << " h " << row.h << " d " << row.length
                                      << " truth " << truth << " found " << found[i];
    EXPECT_GE(found[i], 0.0F);
    worst = std::max(worst, error / allowed);
    if (truth > 1e-30) worst_value = std::max(worst_value, error / truth);
    square += error / allowed * error / allowed;
  }
  std::printf("kind %d g %.2f: largest error %.3f of what is allowed (root mean square %.3g), %.3g of the value, %zu rays\n",
              static_cast<int>(phase.kind), phase.g, worst, std::sqrt(square / static_cast<double>(found.size())), worst_value, found.size());
}

INSTANTIATE_TEST_SUITE_P(All, AirlightPhase,
                         testing::Values(Phase{PhaseKind::isotropic, 0}, Phase{PhaseKind::rayleigh, 0},
                                         Phase{PhaseKind::henyey_greenstein, 0.6}, Phase{PhaseKind::henyey_greenstein, -0.6},
                                         Phase{PhaseKind::henyey_greenstein, 0.9}, Phase{PhaseKind::henyey_greenstein, -0.9},
                                         Phase{PhaseKind::henyey_greenstein, 0.97}, Phase{PhaseKind::henyey_greenstein, -0.97},
                                         Phase{PhaseKind::henyey_greenstein, 0.99}, Phase{PhaseKind::henyey_greenstein, -0.99},
                                         Phase{PhaseKind::cornette_shanks, 0.6}, Phase{PhaseKind::cornette_shanks, 0.95},
                                         Phase{PhaseKind::mie_hazy, 0}, Phase{PhaseKind::mie_murky, 0}));

TEST(Airlight, IsFiniteAndNotNegativeForExtremeRays) {
  for (const Phase phase : {Phase{PhaseKind::isotropic, 0}, Phase{PhaseKind::henyey_greenstein, 0.99}}) {
    const std::vector<float> tables = airlight_tables(phase, default_nodes);
    PointAirlightInputs in;
    for (const double k : {0.0, 1e-30, 1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6}) {
      for (const double h : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
        for (const double foot : {-1e6, -1e3, -1.0, -1e-6, 0.0, 1e-6, 1.0, 1e3, 1e6}) {
          for (const double x1 : {0.0, 1e-6, 1.0, 1e3, 1e6, 1e12, 1e20, 1e30}) {
            in.extinction.push_back(static_cast<float>(k));
            in.foot.push_back(static_cast<float>(foot));
            in.h.push_back(static_cast<float>(h));
            in.x0.push_back(0);
            in.x1.push_back(static_cast<float>(x1));
          }
        }
      }
    }
    const std::vector<float> expected = point_airlight_float(phase, tables, in);
    for (const Simd simd : available_simd()) {
      const std::vector<float> found = point_airlight_simd(phase, tables, in, simd);
      EXPECT_EQ(found, expected) << name_of(simd);
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_TRUE(std::isfinite(found[i]) && found[i] >= 0)
            << found[i] << " at k " << in.extinction[i] << " h " << in.h[i] << " foot " << in.foot[i] << " x1 " << in.x1[i];
      }
    }
  }
}

TEST(Airlight, DirectionalLightHasItsClosedForm) {
  const double sigma = 0.3, length = 7, mu = 0.4;
  const double truth = f64::phase_rayleigh(mu) * (1 - std::exp(-sigma * length));
  EXPECT_NEAR(f64::directional_airlight(1, 0, sigma, mu, 0, length), truth, 1e-14);
  EXPECT_NEAR(f64::directional_airlight(1, 0, sigma, mu, 0, 1e30), f64::phase_rayleigh(mu), 1e-14);
  // The limit of thin fog is the length: relative accuracy is kept.
  EXPECT_NEAR(f64::directional_airlight(0, 0, 1e-9, mu, 0, length) / (1e-9 * length * f64::phase_isotropic()), 1, 1e-8);
}

}  // namespace

}  // namespace airlight
