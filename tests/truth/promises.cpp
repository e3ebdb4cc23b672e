// What a goal promises: technique and knobs chosen by the stored models, their error measured. Times are only told.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <thread>

#include "app/airlight.h"
#include "common/reference/reference.h"
#include "common/techniques/choose.h"
#include "tests/tolerances.h"
#include "tests/truth/gaussian_scenes.h"
#include "tests/truth/relative_error.h"
#include "tests/truth/truth_scenes.h"

namespace airlight {
namespace {

constexpr Extent extent{64, 48};

class Promises : public testing::TestWithParam<TruthScene> {};

TEST_P(Promises, AreKeptWithinAFactorOfTwo) {
  const Scene scene = GetParam().make();
  NoProgress progress;
  const int threads = static_cast<int>(std::thread::hardware_concurrency());
  const ReferenceFrame truth = reference_frame(scene, extent, {1e-5, true, Indirect::unbounded}, true, threads, progress);
  Renderer renderer({.backend = "cpu"});
  int kept = 0;
  for (const char* asked : {"10%", "3%", "1%", "0.3%", "0.1%", "0.03%"}) {
    RenderSettings settings;
    settings.goal = goal_of(asked, {});
    settings.resolution = extent;
    std::string chosen;
    try {
      chosen = chosen_for_goal(scene, settings, {}).second;
    } catch (const InputError& none) {
      std::printf("%s: %s\n", asked, none.what());
      continue;
    }
    const Frame frame = renderer.render(scene, settings);
    const double error = relative_error(frame.image("beauty"), truth, parts[0]).off_edges;
    std::printf("%s: %s; measured %.3g %% and %.3g ms with cold tables\n", asked, chosen.c_str(), 100 * error,
                1e3 * frame.stats.seconds);
    EXPECT_FALSE(!(error <= tolerance("promise") * *settings.goal.error)) << asked;
    ++kept;
  }
  EXPECT_GE(kept, 3);
}

std::vector<TruthScene> scenes() {
  std::vector<TruthScene> all(stored_scenes().begin(), stored_scenes().end());
  for (const TruthScene& scene : gaussian_scenes()) {
    const bool known = std::any_of(all.begin(), all.end(), [&](const TruthScene& t) { return t.name == scene.name; });
    if (!known && scene.make().medium.gaussians.size() < 100) all.push_back(scene);
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Truth, Promises, testing::ValuesIn(scenes()),
                         [](const auto& test) { return std::string(test.param.name); });

// The search itself, by the models alone.
TEST(Choose, TakesTheCheapestOrTheBestAndSaysWhatComesNearest) {
  const Scene scene = lamp_in_gaussians();
  const Choice rough = choose(scene, {800, 600}, goal_of("10%", {}), "", 2),
               fine = choose(scene, {800, 600}, goal_of("1%", {}), "", 2);
  EXPECT_LE(rough.estimate.error, 0.1);
  EXPECT_LE(fine.estimate.error, 0.01);
  EXPECT_LT(rough.estimate.seconds, fine.estimate.seconds);
  const Choice timed = choose(scene, {800, 600}, goal_of({}, "2s"), "", 2);
  EXPECT_LE(timed.estimate.seconds, 2);
  try {
    choose(scene, {800, 600}, goal_of("0.00001%", {}), "", 2);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("nearest is gaussian-airlight"), std::string::npos) << error.what();
  }
  RenderSettings both;
  both.goal = goal_of("1%", {});
  both.knobs = {{"steps", "4"}};
  EXPECT_THROW(chosen_for_goal(scene, both, {}), InputError);
}

// A baseline whose error is not known before it is rendered: it serves no goal, not even one of time. What else a scene says
// holds.
TEST(Choose, NeverTakesThePublishedOrder) {
  Scene scene = homogeneous_scenes()[0].make();
  ASSERT_TRUE(scene.surfaces[0].casts_shadow);
  const auto shadows_of = [&](const Goal& goal) {
    RenderSettings settings;
    settings.technique = "shadow-planes";
    settings.goal = goal;
    const std::string told = explain(scene, settings), name = "shadows = ";
    return told.substr(told.find(name) + name.size(), 2);
  };
  const Goal rough = goal_of("1000%", {}), fast = goal_of({}, "100s");
  for (const Goal& goal : {rough, fast}) EXPECT_EQ(shadows_of(goal), "on");
  scene.technique = "shadow-planes";
  scene.settings = {{"shadows", "off"}};
  for (const Goal& goal : {rough, fast}) EXPECT_EQ(shadows_of(goal), "of");
  scene.settings = {{"shadows", "published"}};
  for (const Goal& goal : {rough, fast}) {
    try {
      choose(scene, extent, goal, "shadow-planes", 2);
      FAIL();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("shadow-planes: how large its error is"), std::string::npos) << error.what();
    }
  }
  for (Surface& s : scene.surfaces) s.casts_shadow = false;  // then it is exact
  EXPECT_EQ(choose(scene, extent, rough, "shadow-planes", 2).technique, "shadow-planes");
}

// The same of the airlight as it is published, whatever the scene asks for.
TEST(Choose, NeverTakesThePublishedAirlight) {
  Scene scene = lamp_in_gaussians();
  for (const bool asked : {false, true}) {
    if (asked) scene.technique = "gaussian-airlight", scene.settings = {{"light_path", "published"}};
    for (const Goal& goal : {goal_of("1000%", {}), goal_of({}, "100s")}) {
      const Choice chosen = choose(scene, extent, goal, "gaussian-airlight", 2);
      EXPECT_EQ(chosen.text().find("published"), std::string::npos) << chosen.text();
      EXPECT_NE(chosen.text().find("light_path="), std::string::npos) << chosen.text();
    }
  }
}

}  // namespace
}  // namespace airlight
