// The sweep over a plane finds the pairs that a look at all of them finds, each once.
#include "common/plan/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/parity/inputs.h"

namespace airlight {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

bool holds(const SweptRange& i, double at) { return i.least <= at && at <= i.most; }

// Coordinates are multiples of 1 / steps, so that many are equal.
void compare(std::uint32_t stream, unsigned count, unsigned boxes_count, double steps, double width) {
  std::uint32_t next = 0;
  const auto number = [&] { return std::floor(uniform(stream, next++) * steps) / steps; };
  std::vector<SweptPoint> points;
  std::vector<SweptBox> boxes;
  for (unsigned i = 0; i < count; ++i) points.push_back({number(), number()});
  for (unsigned i = 0; i < boxes_count; ++i) {
    const double x = number(), y = number();
    // Some of no size, some that hold nothing.
    const double w = width * number() * (i % 7 == 0 ? 0 : 1), h = width * number() * (i % 11 == 0 ? -1 : 1);
    boxes.push_back({{x, x + w}, {y, y + h}, i / 2});
  }
  Pairs found, all;
  Sweep(points, boxes).each([&](std::uint32_t point, std::uint32_t owner) { found.emplace_back(point, owner); });
  for (std::uint32_t p = 0; p < count; ++p) {
    for (const SweptBox& b : boxes) {
      if (holds(b.along, points[p].along) && holds(b.across, points[p].across)) all.emplace_back(p, b.owner);
    }
  }
  std::sort(found.begin(), found.end());
  std::sort(all.begin(), all.end());
  EXPECT_EQ(found, all) << count << " points, " << boxes_count << " boxes";
}

TEST(Sweep, FindsThePairsThatAreThere) {
  for (std::uint32_t k = 0; k < 40; ++k) {
    compare(600 + k, 1 + 7 * k, 3 * k, 1e9, 0.3);
    compare(700 + k, 5 * k, 1 + 6 * k, 12, 0.5);
  }
  compare(800, 2000, 1500, 1e9, 0.05);
}

TEST(Sweep, NothingIsInNothing) {
  const std::vector<SweptPoint> points{{0, 0}};
  const std::vector<SweptBox> boxes{{{-1, 1}, {-1, 1}, 0}};
  const auto never = [](std::uint32_t, std::uint32_t) { ADD_FAILURE(); };
  Sweep({}, {}).each(never);
  Sweep(points, {}).each(never);
  Sweep({}, boxes).each(never);
}

}  // namespace
}  // namespace airlight
