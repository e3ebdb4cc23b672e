// Functions of an angle by their harmonics: the point spread function of light that scatters once, and phase functions.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "common/plan/zonal.h"
#include "tests/formulas/rows.h"
#include "tests/tolerances.h"

namespace airlight {
namespace {

TEST(Zonal, PointSpreadFunctionIsThatOfTheTable) {
  double worst = 0;
  for (const auto& row : csv_rows("reference/npsf.csv"))
    worst = std::max(worst, std::fabs(npsf(number(row[0])) / number(row[1]) - 1));
  std::printf("relative error %.2g\n", worst);
  EXPECT_FALSE(!(worst <= tolerance("npsf")));
}

// As Zhou et al. print them, which are 3e-5 off.
TEST(Zonal, CoefficientsOfThePointSpreadFunctionAreThePapers) {
  constexpr Zonal printed{0.332818, 0.332488, 0.302428, 0.275773, 0.254051, 0.236333};
  const Zonal found = npsf_coefficients();
  double worst = 0;
  for (std::size_t l = 0; l < 6; ++l) {
    std::printf("%.9f, printed %.6f\n", found[l], printed[l]);
    worst = std::max(worst, std::fabs(found[l] - printed[l]));
  }
  EXPECT_FALSE(!(worst <= tolerance("npsf_printed")));
}

// Of Henyey and Greenstein's g^l, beside its y_l0 at the axis; of Rayleigh's 1, 0, 1/10.
TEST(Zonal, PhaseFunctionsHaveClosedForms) {
  const auto expect = [](const Phase& phase, const Zonal& factors) {
    const Zonal found = phase_coefficients(phase);
    double worst = 0;
    for (std::size_t l = 0; l < 6; ++l) {
      const double factor = found[l] * std::sqrt(4 * 3.141592653589793 / (2 * static_cast<double>(l) + 1));
      worst = std::max(worst, std::fabs(factor - factors[l]));
    }
    std::printf("phase %d, g %g: error %.2g\n", static_cast<int>(phase.kind), phase.g, worst);
    EXPECT_FALSE(!(worst <= tolerance("phase_coefficients")));
  };
  for (const double g : {-0.5, 0.0, 0.6, 0.99}) {
    Zonal powers{1};
    for (std::size_t l = 1; l < 6; ++l) powers[l] = powers[l - 1] * g;
    expect({PhaseKind::henyey_greenstein, g}, powers);
  }
  expect({PhaseKind::isotropic, 0}, {1, 0, 0, 0, 0, 0});
  expect({PhaseKind::rayleigh, 0}, {1, 0, 0.1, 0, 0, 0});
}

}  // namespace
}  // namespace airlight
