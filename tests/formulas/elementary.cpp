// exp_ and log_ over their domain, against the C library in double; the same bits on every target.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>

#include "tests/formulas/builds.h"
#include "tests/tolerances.h"

namespace airlight {

namespace {

double ulps(float found, double truth) {
  const double spacing = std::ldexp(1.0, std::max(std::ilogb(truth), -126) - 23);
  return std::fabs(static_cast<double>(found) - truth) / spacing;
}

TEST(Elementary, ExpIsWithinItsBound) {
  std::vector<float> x;
  for (int i = 0; i <= 1750000; ++i) x.push_back(-87.0F + static_cast<float>(i) * 1e-4F);
  const std::vector<float> found = exp_simd(x, available_simd().back());
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, ulps(found[i], std::exp(static_cast<double>(x[i]))));
  std::printf("exp_: at most %.3f ULP\n", worst);
  EXPECT_FALSE(!(worst <= tolerance("exp_ulp")));
  for (const Simd simd : available_simd()) EXPECT_EQ(exp_simd(x, simd), found) << name_of(simd);
}

TEST(Elementary, ExpOfFarNumbersIsHeldAtNormalFloats) {
  const std::vector<float> x{-1e30F, -100, -87.3F, 89, 1e30F};
  for (const float y : exp_simd(x, available_simd().back())) EXPECT_TRUE(std::isnormal(y)) << y;
}

TEST(Elementary, LogIsWithinItsBound) {
  std::vector<float> x;
  for (std::uint32_t bits = 0x00800000; bits < 0x7f800000; bits += 1021) x.push_back(std::bit_cast<float>(bits));
  const std::vector<float> found = log_simd(x, available_simd().back());
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double truth = std::log(static_cast<double>(x[i]));
    worst = std::max(worst, truth == 0 ? std::fabs(static_cast<double>(found[i])) : ulps(found[i], truth));
  }
  std::printf("log_: at most %.3f ULP on %zu numbers\n", worst, x.size());
  EXPECT_FALSE(!(worst <= tolerance("log_ulp")));
  for (const Simd simd : available_simd()) EXPECT_EQ(log_simd(x, simd), found) << name_of(simd);
}

}  // namespace

}  // namespace airlight
