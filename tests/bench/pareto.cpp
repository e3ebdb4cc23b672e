// What airlight-pareto decides, on points made by hand; no times.
#include <gtest/gtest.h>

#include "bench/pareto/files.h"
#include "bench/pareto/measure.h"
#include "common/error.h"
#include "common/plan/goal.h"

namespace airlight {
namespace {

Point point(const char* backend, double ms, double error) {
  Point p;
  p.configuration = {"marching", backend, {{"steps", "4"}}};
  p.ms = p.small_ms = ms;
  p.error = {error, error};
  return p;
}

TEST(Pareto, FrontIsWhatNothingBeats) {
  std::vector<Point> points{point("cpu", 10, 0.1), point("cpu", 20, 0.1),  point("cpu", 20, 0.05),
                            point("cpu", 5, 0.5),  point("gl", 100, 0.07), point("cpu", 0, 0.001)};
  mark_fronts(points);
  std::vector<bool> on;
  for (const Point& p : points) on.push_back(p.on_front);
  EXPECT_EQ(on, (std::vector<bool>{true, false, true, true, true, false}));  // the last one was not timed
}

TEST(Pareto, OnlyWhatIsNearTheFrontIsTimed) {
  const std::vector<Point> points{point("cpu", 10, 0.1), point("cpu", 15, 0.1), point("cpu", 25, 0.1), point("gl", 25, 0.1)};
  EXPECT_EQ(near_front(points, 0.6), (std::vector<bool>{true, true, false, true}));
  EXPECT_EQ(near_front(points, 0), (std::vector<bool>{true, true, true, true}));
}

TEST(Pareto, ChoosesTheCheapestAndTheBest) {
  const std::vector<Point> points{point("cpu", 10, 0.1), point("cpu", 20, 0.02), point("cpu", 40, 0.005)};
  EXPECT_EQ(cheapest_within_error(points, 0.03), &points[1]);
  EXPECT_EQ(cheapest_within_error(points, 0.001), nullptr);
  EXPECT_EQ(best_within_time(points, 30), &points[1]);
  EXPECT_EQ(best_within_time(points, 5), nullptr);
}

TEST(Pareto, SweepsAreProducts) {
  std::vector<Knob> knobs(3);
  knobs[0].name = "a", knobs[0].sweep = {"1", "2", "3"};
  knobs[1].name = "b";
  knobs[2].name = "c", knobs[2].sweep = {"x", "y"};
  const std::vector<Settings> all = products(knobs);
  ASSERT_EQ(all.size(), 6U);
  EXPECT_EQ(text_of(all.front()), "a=1 c=x");
  EXPECT_EQ(text_of(all.back()), "a=3 c=y");
}

TEST(Pareto, KnobsThatDoNothingAreNotSwept) {
  Scene scene;
  scene.medium.extinction = 0.1;
  scene.lights.emplace_back();
  const Technique& marching = technique("marching");
  const std::size_t steps = marching.knobs[0].sweep.size();
  EXPECT_EQ(different_settings(marching, scene, {32, 24}).size(), steps);
  scene.medium.gaussians.emplace_back();
  // Marched toward the light with each number of steps, or by the closed form with none.
  EXPECT_EQ(different_settings(marching, scene, {32, 24}).size(), steps * (marching.knobs[1].sweep.size() + 1));
}

TEST(Pareto, WritesWhatAReaderExpects) {
  Measurement m;
  m.points = {point("cpu", 10, 0.1)};
  const Origin origin{"a, \"b\"", "c", "d", {8, 6}, {4, 3}};
  EXPECT_EQ(csv_of(m, origin),
            "scene,technique,backend,knobs,error,error_off_edges,ms,small_ms,on_front\n"
            "\"a, \"\"b\"\"\",marching,cpu,steps=4,0.1,0.1,10,10,0\n");
  const std::string json = json_of(m, origin);
  EXPECT_NE(json.find("\"scene\": \"a, \\\"b\\\"\""), std::string::npos) << json;
  EXPECT_NE(json.find("\"knobs\": { \"steps\": \"4\" }"), std::string::npos) << json;
}

TEST(Pareto, ErrorIsRelativeToTheMean) {
  Truth truth{HostImage({2, 1}, 3), {false, true}};
  HostImage image({2, 1}, 3);
  for (std::size_t i = 0; i < 6; ++i) truth.beauty.values[i] = 2, image.values[i] = i < 3 ? 2.2F : 3;
  const RelativeError e = relative_error(image, truth);
  EXPECT_NEAR(e.off_edges, 0.1, 1e-6);
  EXPECT_NEAR(e.everywhere, std::sqrt((0.04 + 1) / 2) / 2, 1e-6);
}

TEST(Goal, ReadsUnitsAndRefusesTheRest) {
  EXPECT_DOUBLE_EQ(*goal_of("1%", "").error, 0.01);
  EXPECT_DOUBLE_EQ(*goal_of("0.5", "").error, 0.5);
  EXPECT_DOUBLE_EQ(*goal_of("", "30ms").seconds, 0.03);
  EXPECT_DOUBLE_EQ(*goal_of("", "0.2s").seconds, 0.2);
  EXPECT_FALSE(goal_of("", ""));
  for (const char* wrong : {"-1%", "0", "x", "1 %", "1%%", "nan", "inf", "1e400", "%"})
    EXPECT_THROW(goal_of(wrong, ""), InputError) << wrong;
  for (const char* wrong : {"30", "ms", "-1s", "1 ms", "1m", "1mss"}) EXPECT_THROW(goal_of("", wrong), InputError) << wrong;
  EXPECT_THROW(goal_of("1%", "1s"), InputError);
}

}  // namespace
}  // namespace airlight
