// Every check in every build of the formulas; the largest error is printed also where it is allowed.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstdio>
#include <ostream>

#include "tests/formulas/builds.h"
#include "tests/tolerances.h"

namespace airlight {

static void PrintTo(const Check& check, std::ostream* out) { *out << check.name; }

namespace {

std::string gtest_name(const testing::TestParamInfo<Check>& info) { return info.param.name; }

class Formulas : public testing::TestWithParam<Check> {};

void hold(const Check& check, const char* build, std::string_view bound, const Run& run) {
  const Measured m = check.measure(run);
  std::printf("%s, %s: largest error %.3g (allowed %.3g) of %zu, %s\n", check.name.c_str(), build, m.error, tolerance(bound),
              m.count, m.where.c_str());
  EXPECT_GT(m.count, 0U) << build;
  EXPECT_FALSE(!(m.error <= tolerance(bound))) << build << ": " << m.error << " at " << m.where;
}

TEST_P(Formulas, HoldInDouble) { hold(GetParam(), "double", GetParam().double_bound, run_double); }

// One run is measured; every SIMD target gives the same bits.
TEST_P(Formulas, HoldInFloatAndSimd) {
  const auto bits = [](double x) { return std::bit_cast<std::uint32_t>(static_cast<float>(x)); };
  const auto run = [&](const Calls& calls) {
    const Columns expected = run_float(calls);
    for (const Simd simd : available_simd()) {
      const Columns found = run_simd(calls, simd);
      std::size_t differ = 0, first = 0;
      for (std::size_t k = 0; k < expected.size(); ++k) {
        for (std::size_t i = 0; i < expected[k].size(); ++i) {
          if (bits(expected[k][i]) != bits(found[k][i]) && differ++ == 0) first = i;
        }
      }
      EXPECT_EQ(differ, 0U) << name_of(simd) << " differs from float, first in call " << first;
    }
    return expected;
  };
  std::string build = "float";
  for (const Simd simd : available_simd()) build += " = " + std::string(name_of(simd));
  hold(GetParam(), build.c_str(), GetParam().float_bound, run);
}

TEST_P(Formulas, HoldInGlsl) { hold(GetParam(), "GLSL", GetParam().float_bound, run_glsl); }

INSTANTIATE_TEST_SUITE_P(All, Formulas, testing::ValuesIn(all_checks()), gtest_name);

}  // namespace

}  // namespace airlight
