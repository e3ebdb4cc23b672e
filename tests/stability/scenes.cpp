// Hostile scenes: numbers that are numbers, the same bits whatever runs, CPU as GL, and the truth where it is known.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/stability/hostile.h"
#include "tests/stability/trial.h"

namespace airlight {
namespace {

constexpr std::uint32_t parts = 6, scenes = 300;

class Hostile : public testing::TestWithParam<std::uint32_t> {};

// The others are for ./dev soak.
TEST_P(Hostile, ScenesRenderAlikeAndTruly) {
  Trials trials;
  int tried = 0, truths = 0, on_gl = 0;
  double apart = 0, worst = 0;
  for (std::uint32_t k = 0; k < scenes / parts; ++k) {
    const std::uint32_t number = GetParam() * (scenes / parts) + k;
    const HostileScene hostile = hostile_scene(number);
    const Asked asked = asked_of(hostile.scene, number);
    if (asked.technique.empty()) continue;
    const bool gl = number % 6 == 0;
    const Trial trial = trials.run(hostile.scene, asked, number, {.gl = gl, .truth_pixels = 16});
    ++tried;
    on_gl += gl ? 1 : 0, truths += trial.truth ? 1 : 0;
    apart = std::max(apart, trial.gl_apart), worst = std::max(worst, trial.truth ? trial.error / (trial.promise + 1e-9) : 0.0);
    for (const std::string& line : trial.failures)
      ADD_FAILURE() << "scene " << number << ": " << asked.text() << "; " << hostile.traits << ": " << line;
  }
  std::printf("%d scenes, %d on GL (at most %.2g apart), %d held to the truth (at most %.2g of what is promised)\n", tried, on_gl,
              apart, truths, worst);
  EXPECT_GT(truths, 8);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Hostile, testing::Range(std::uint32_t{0}, parts));

}  // namespace
}  // namespace airlight
