// The oracle of the airlight checks against the high-precision table, and what of exp_ concerns the single-precision builds
// alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/formulas/airlight_truth.h"
#include "tests/formulas/builds.h"
#include "tests/formulas/rows.h"
#include "tests/tolerances.h"

namespace airlight {

namespace {

TEST(Oracle, AgreesWithTheTable) {
  ASSERT_EQ(airlight_rows().size(), 240U);
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

TEST(Elementary, ExpOfFarNumbersIsHeldAtNormalFloats) {
  const Calls calls{Formula::exp, {{-static_cast<double>(1e30F), -100, -88, 89, static_cast<double>(1e30F)}}};
  for (const Columns& found : {run_float(calls), run_glsl(calls)}) {
    for (const double y : found[0]) EXPECT_TRUE(std::isnormal(static_cast<float>(y))) << y;
  }
}

TEST(Glsl, RunsOnLlvmpipe) {
  std::printf("%s\n", glsl_renderer().c_str());
  EXPECT_NE(glsl_renderer().find("llvmpipe"), std::string::npos) << glsl_renderer();
}

}  // namespace

}  // namespace airlight
