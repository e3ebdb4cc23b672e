// The reference's random numbers and directions: against published answers, against the phase functions.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "common/formulas/double.h"
#include "common/reference/phase_sampling.h"

namespace airlight {
namespace {

using Block = std::array<std::uint32_t, 4>;

// Known answers of the authors' own distribution (philox4x32, 10 rounds).
TEST(Philox, KnownAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({~0U, ~0U, ~0U, ~0U}, {~0U, ~0U}), (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, NumbersOfAPath) {
  Random one({1, 2}, 3), again({1, 2}, 3), other({1, 2}, 3 + (1ULL << 32));
  double sum = 0, squares = 0;
  int equal = 0;
  constexpr int count = 100000;
  for (int i = 0; i < count; ++i) {
    const double x = one.next();
    ASSERT_EQ(x, again.next());
    ASSERT_TRUE(x >= 0 && x < 1);
    equal += x == other.next() ? 1 : 0;
    sum += x, squares += x * x;
  }
  EXPECT_EQ(equal, 0);
  EXPECT_NEAR(sum / count, 0.5, 4 / std::sqrt(12.0 * count));
  EXPECT_NEAR(squares / count, 1.0 / 3, 4 * std::sqrt(4 / 45.0 / count));
}

constexpr int bins = 24;

// Of the cosine after scattering, weights counted, against the phase function of `expected`: its mean is the number of bins.
double chi_square(const Phase& drawn, const Phase& expected) {
  constexpr int samples = 200000, nodes = 4000;
  // Bins of equal shares, by midpoint sums over the angle, which resolve the narrowest peak.
  std::vector<double> ends, shares(1, 0);
  for (int i = 0; i < nodes; ++i) {
    const double angle = std::numbers::pi * (i + 0.5) / nodes;
    const double share = f64::phase_value(static_cast<int>(expected.kind), expected.g, std::cos(angle)) * 2 * std::numbers::pi *
                         std::sin(angle) * std::numbers::pi / nodes;
    shares.back() += share;
    if (shares.back() >= 1.0 / bins && ends.size() + 1 < bins) {
      ends.push_back(std::cos(std::numbers::pi * (i + 1) / nodes));
      shares.push_back(0);
    }
  }
  std::vector<double> sum(shares.size()), squares(shares.size());
  const glm::dvec3 from = glm::normalize(glm::dvec3(0.4, -0.7, 0.2));
  Random random({7, 9}, 0);
  glm::dvec3 mean(0);
  for (int k = 0; k < samples; ++k) {
    const ScatteredDirection to = scattered_direction(drawn, from, random);
    EXPECT_NEAR(glm::length(to.direction), 1, 1e-14);
    std::size_t bin = 0;
    while (bin < ends.size() && glm::dot(from, to.direction) < ends[bin]) ++bin;
    sum[bin] += to.weight, squares[bin] += to.weight * to.weight;
    mean += to.direction / static_cast<double>(samples);
  }
  EXPECT_LT(glm::length(mean - glm::dot(mean, from) * from), 5 / std::sqrt(samples));  // all azimuths alike
  double chi = 0;
  for (std::size_t b = 0; b < shares.size(); ++b) {
    const double variance = squares[b] - samples * shares[b] * shares[b], apart = sum[b] - samples * shares[b];
    chi += apart * apart / std::max(variance, samples * shares[b] * (1 - shares[b]) * 0.5);
  }
  return chi;
}

TEST(ScatteredDirection, FollowsThePhaseFunction) {
  const Phase phases[] = {{},
                          {PhaseKind::rayleigh, 0},
                          {PhaseKind::henyey_greenstein, 0},
                          {PhaseKind::henyey_greenstein, 0.8},
                          {PhaseKind::henyey_greenstein, -0.6},
                          {PhaseKind::henyey_greenstein, 0.99},
                          {PhaseKind::cornette_shanks, 0.7},
                          {PhaseKind::mie_hazy, 0},
                          {PhaseKind::mie_murky, 0}};
  for (const Phase& phase : phases) {
    const double chi = chi_square(phase, phase);
    std::printf("kind %d, g = %g: chi-square %.1f of %d bins\n", static_cast<int>(phase.kind), phase.g, chi, bins);
    EXPECT_FALSE(!(chi < bins + 5 * std::sqrt(2.0 * bins)));
  }
  // It sees a phase function that is another by little, and one that scatters the other way.
  EXPECT_GT(chi_square({PhaseKind::henyey_greenstein, 0.78}, {PhaseKind::henyey_greenstein, 0.8}), 20 * bins);
  EXPECT_GT(chi_square({PhaseKind::henyey_greenstein, 0.6}, {PhaseKind::henyey_greenstein, -0.6}), 20 * bins);
  EXPECT_GT(chi_square({}, {PhaseKind::rayleigh, 0}), 20 * bins);
}

}  // namespace
}  // namespace airlight
