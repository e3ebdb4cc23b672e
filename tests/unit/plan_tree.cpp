// What explain() and --stats tell: steps with their inputs, reasons and costs, what is kept and what is left out, by which rule.
#include "app/plan_tree.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "app/airlight.h"
#include "common/plan/cost.h"
#include "common/plan/rules.h"
#include "common/techniques/technique.h"
#include "tests/unit/small_work.h"

namespace airlight {
namespace {

Work lit_blobs() {
  Work work = small_work("opacity-propagation");
  work.set("density", "volume");
  return work;
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

void tells(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words) EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
}

TEST(PlanTree, TellsInputsReasonsAndCosts) {
  const Work work = lit_blobs();
  const std::string text = explain(work.scene, work.settings);
  std::printf("%s", text.c_str());
  tells(text, {"\n  compose: surface + airlight (about ", "\n    surface <- surface_shading: direct light on the surfaces",
               "\n    airlight <- ray_march, above\n", "transmittance <- ray_march: the view ray through the medium",
               "depths <- optical_depth_propagation of 2: the optical depth from a light to everywhere",
               "voxels <- density_injection: the medium's extinction on a grid (about ", "<- surface_visibility, above\n",
               "positions, normals, triangles <- the scene\n", "\nleft out\n",
               "indirect single scattering: indirect = off (no-indirect)\n"});
  EXPECT_EQ(count(text, ": what each pixel sees"), 1U) << text;
  EXPECT_EQ(text.find("kept"), std::string::npos) << text;
}

// Static medium and lights propagate nothing: a second frame says so before it is rendered, and after.
TEST(PlanTree, TellsWhatIsKept) {
  Work work = lit_blobs();
  Renderer renderer({.backend = "cpu"});
  EXPECT_EQ(renderer.explain(work.scene, work.settings), explain(work.scene, work.settings));
  renderer.render(work.scene, work.settings);
  work.scene.camera.position.x += 0.1;
  const char* const kept[] = {
      "optical_depth_propagation of 2: the optical depth from a light to everywhere (kept from the last frame",
      "density_injection: the medium's extinction on a grid (kept from the last frame"};
  const std::string before = renderer.explain(work.scene, work.settings);
  const Frame frame = renderer.render(work.scene, work.settings);
  const std::string after = stats_text(frame);
  std::printf("%s", after.c_str());
  for (const std::string& text : {before, after}) {
    tells(text, {kept[0], kept[1]});
    EXPECT_EQ(text.find("ray_march: the view ray through the medium, step by step (kept"), std::string::npos) << text;
  }
  tells(after, {" ms, 192 items, ", " items skipped"});

  work.scene.lights[0].position.x += 0.1;
  tells(renderer.explain(work.scene, work.settings), {"1 of them kept from the last frame"});
  renderer.render(work.scene, work.settings);
  renderer.render(work.scene, work.settings);
  const std::string unchanged = renderer.explain(work.scene, work.settings);
  tells(unchanged, {"nothing runs: all is as in the last frame (unchanged)"});
  for (const StepStats& step : renderer.render(work.scene, work.settings).stats.steps) {
    EXPECT_TRUE(step.reused) << step.name;
    EXPECT_EQ(step.items, 0U) << step.name;
  }
}

// While the camera stands still an edit runs what depends on it alone; where no memory may be taken for that, more.
TEST(PlanTree, AMaterialMarchesNothingWhileTheCameraStandsStill) {
  for (const std::size_t keep : {std::size_t{1} << 20U, std::size_t{0}}) {
    Work work = lit_blobs();
    Renderer renderer({.backend = "cpu", .keep = keep});
    for (int i = 0; i < 2; ++i) {
      work.scene.background.x += 0.1;
      renderer.render(work.scene, work.settings);
    }
    work.scene.surfaces[0].material.diffuse.x = 0.1F;
    const Frame frame = renderer.render(work.scene, work.settings);
    std::set<std::string> ran;
    for (const StepStats& step : frame.stats.steps)
      if (!step.reused) ran.insert(step.name);
    EXPECT_EQ(ran == (std::set<std::string>{"surface_shading", "compose"}), keep > 0);
    EXPECT_EQ(ran.contains("ray_march"), keep == 0);
    Renderer cold({.backend = "cpu"});
    EXPECT_EQ(frame.image("beauty").values, cold.render(work.scene, work.settings).image("beauty").values);
  }
}

TEST(PlanTree, CostsGrowWithWhatThereIs) {
  for (const Technique& t : techniques()) {
    if (!t.plan) continue;
    Work work = small_work(t.name);
    const auto cost = [&] {
      FrameRequest request;
      request.extent = *work.settings.resolution;
      request.images = {"beauty"};
      request.knobs = KnobValues(t.knobs, work.settings.knobs);
      double seconds = 0;
      for (const Step& step : t.plan(work.scene, request).steps) {
        const StepCost one = cost_of(step.what);
        EXPECT_GT(one.items, 0U) << name_of(step.what);
        EXPECT_GT(one.bytes, 0U) << name_of(step.what);
        EXPECT_GE(one.seconds, 0) << name_of(step.what);
        seconds += one.seconds;
      }
      return seconds;
    };
    const double once = cost();
    work.settings.resolution = Extent{32, 24};
    EXPECT_GT(cost(), once) << t.name;
    const double larger = cost();
    work.scene.lights.push_back(small_lamp({0, 3, 0}));
    EXPECT_GT(cost(), larger) << t.name;
  }
}

// Each rule is named once, and the results tell what it gains.
TEST(Rules, AreNamedAndMeasured) {
  std::ifstream file(AIRLIGHT_SOURCE "/docs/RESULTS.md");
  const std::string results(std::istreambuf_iterator<char>(file), {});
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < rule_names.size(); ++i) {
    const auto& [rule, name] = rule_names[i];
    EXPECT_EQ(static_cast<std::size_t>(rule), i) << name;
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_NE(results.find("| `" + std::string(name) + "` |"), std::string::npos) << name << " is not in docs/RESULTS.md";
  }
}

}  // namespace
}  // namespace airlight
