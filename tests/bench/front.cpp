// What airlight-pareto decides, on points made by hand; no times are measured.
#include <gtest/gtest.h>

#include <limits>

#include "bench/pareto/front.h"

namespace airlight {
namespace {

Point point(const char* backend, double ms, double error, const char* technique = "marching") {
  Point p;
  p.configuration = {technique, backend, {{"steps", "4"}}};
  p.ms = p.small_ms = ms;
  p.error = {error, error};
  return p;
}

TEST(Front, IsWhatNothingOfItsBackendBeats) {
  const double endless = std::numeric_limits<double>::infinity();
  std::vector<Point> points{point("cpu", 10, 0.1),    point("cpu", 20, 0.1),  point("cpu", 20, 0.05, "other"),
                            point("cpu", 5, 0.5),     point("gl", 100, 0.07), point("cpu", 0, 0.001),
                            point("cpu", 1, endless), point("cpu", 5, 0.5)};
  mark_fronts(points);
  std::vector<bool> on;
  for (const Point& p : points) on.push_back(p.on_front);
  // Not: what is slower for the same error, what was not timed, what has no error; equal ones are both on it.
  EXPECT_EQ(on, (std::vector<bool>{true, false, true, true, true, false, false, true}));
}

TEST(Front, OnlyWhatIsNearTheFrontOfItsTechniqueIsTimed) {
  const std::vector<Point> points{point("cpu", 10, 0.1),          point("cpu", 14, 0.1), point("cpu", 16, 0.1),
                                  point("cpu", 16, 0.1, "other"), point("gl", 16, 0.1),  point("cpu", 100, 0.09)};
  EXPECT_EQ(near_front(points, 1.5), (std::vector<bool>{true, true, false, true, true, true}));
  EXPECT_EQ(near_front(points, 1e9), std::vector<bool>(6, true));
}

TEST(Front, ChoosesTheCheapestAndTheMostExact) {
  const std::vector<Point> points{point("cpu", 10, 0.1), point("cpu", 20, 0.02), point("gl", 40, 0.005), point("cpu", 19, 0.02)};
  const auto within_error = [&](double e) { return chosen(points, {.error = e, .seconds = {}}); };
  const auto within_time = [&](double s) { return chosen(points, {.error = {}, .seconds = s}); };
  EXPECT_EQ(within_error(0.03), &points[3]);
  EXPECT_EQ(within_error(0.005), &points[2]);
  EXPECT_EQ(within_error(0.001), nullptr);
  EXPECT_EQ(within_time(0.03), &points[3]);
  EXPECT_EQ(within_time(1), &points[2]);
  EXPECT_EQ(within_time(0.005), nullptr);
  EXPECT_EQ(nearest(points, {.error = 0.001, .seconds = {}}), &points[2]);
  EXPECT_EQ(nearest(points, {.error = {}, .seconds = 0.001}), &points[0]);
  EXPECT_EQ(nearest({point("cpu", 0, 0.1)}, {.error = 0.001, .seconds = {}}), nullptr);
}

}  // namespace
}  // namespace airlight
