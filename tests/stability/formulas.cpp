// Closed forms over their whole domains; more calls in ./dev soak.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/stability/formula_stress.h"
#include "tests/tolerances.h"

namespace airlight {
namespace {

TEST(FormulaStress, HoldOverTheirDomains) {
  std::size_t calls = 0;
  for (const StressedFormula& f : stressed_formulas()) {
    const FormulaStress found = stress(f, 77, 20000);
    std::printf("%s (%s): largest error %.3g of %s, allowed %.3g, at %s\n", f.name.c_str(), f.domain.c_str(),
                found.measured.error, f.scale.c_str(), tolerance(f.bound), found.measured.where.c_str());
    EXPECT_FALSE(!(found.measured.error <= tolerance(f.bound))) << f.name << " at " << found.measured.where;
    EXPECT_EQ(found.not_finite, 0U) << f.name;
    EXPECT_EQ(found.other_bits, 0U) << f.name;
    calls += found.measured.count;
  }
  std::printf("%zu results\n", calls);
}

TEST(FormulaStress, RisesOrFallsOnNeighbouringFloats) {
  for (const StressedFormula& f : stressed_formulas()) {
    if (f.rises == 0) continue;
    const Monotony found = monotony(f, 78, 500);
    const double allowed = 2 * tolerance(f.bound);  // each of the two may be off by its bound
    std::printf("%s: %zu of %zu neighbours step back, at most %.3g of %s, allowed %.3g, at %s\n", f.name.c_str(), found.back,
                found.pairs, found.largest.error, f.scale.c_str(), allowed, found.largest.where.c_str());
    EXPECT_GT(found.pairs, 500U) << f.name;
    EXPECT_FALSE(!(found.largest.error <= allowed)) << f.name << " at " << found.largest.where;
  }
}

}  // namespace
}  // namespace airlight
