// What belongs to a light stays as it is where others come and go: which steps run then, with the bits of a cold frame.
#include "common/plan/light_slots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "common/techniques/technique.h"
#include "tests/unit/small_work.h"

namespace airlight {
namespace {

using Numbers = std::vector<std::uint32_t>;

LightSource lamp_at(double x, const std::string& name = "") {
  LightSource lamp = small_lamp({x, 3, 1});
  lamp.name = name;
  return lamp;
}

TEST(LightSlots, ALightKeepsItsSlot) {
  const LightSource a = lamp_at(1), b = lamp_at(2), c = lamp_at(3), d = lamp_at(4);
  const LightSlots three = LightSlots().after({a, b, c});
  EXPECT_EQ(three.numbers(), (Numbers{0, 1, 2}));
  EXPECT_EQ(three.after({b, c}).numbers(), (Numbers{1, 2}));
  EXPECT_EQ(three.after({a, c}).numbers(), (Numbers{0, 2}));
  EXPECT_EQ(three.after({c, b, a}).numbers(), (Numbers{2, 1, 0}));
  EXPECT_EQ(three.after({d, a, b, c}).numbers(), (Numbers{3, 0, 1, 2}));
  EXPECT_EQ(three.after({b, c}).after({d, b, c}).numbers(), (Numbers{0, 1, 2})) << "free ones are used again";
  EXPECT_EQ(three.after({}).after({d}).numbers(), (Numbers{0}));
  LightSource dim = c;
  dim.power *= 0.5;
  EXPECT_EQ(three.after({a, dim}).numbers(), (Numbers{0, 2}));
  EXPECT_EQ(three.after({a, d, c}).numbers(), (Numbers{0, 1, 2})) << "one that moves keeps its own";
  EXPECT_EQ(three.after({d, c}).numbers(), (Numbers{0, 2}));
  EXPECT_EQ(LightSlots().after({a, a, b}).after({a, b}).numbers(), (Numbers{0, 2})) << "two at one place";
  LightSource sun = a;
  sun.type = LightType::directional;
  EXPECT_EQ(three.after({b, c, sun}).numbers(), (Numbers{1, 2, 0}));
}

TEST(LightSlots, ANameSaysWhichItIs) {
  const LightSlots two = LightSlots().after({lamp_at(1, "key"), lamp_at(2, "fill"), lamp_at(3, "rim")});
  EXPECT_EQ(two.after({lamp_at(7, "rim"), lamp_at(8, "key")}).numbers(), (Numbers{2, 0}));
}

class LightsGo : public testing::TestWithParam<std::string> {};

// Of three lights and a sun each in turn, and comes back in front: the volumes of the others are kept.
TEST_P(LightsGo, AndLeaveTheStepsOfOthers) {
  for (const char* technique : {"opacity-propagation", "gaussian-airlight"}) {
    Work work = small_work(technique);
    if (technique == std::string("gaussian-airlight")) work.set("light_path", "volume");
    LightSource sun = small_lamp({0, 0, 0});
    sun.type = LightType::directional;
    sun.direction = {0, -1, 0};
    work.scene.lights = {small_lamp({2, 4, 1}), small_lamp({-3, 4, 1}), small_lamp({0, 5, -2}), sun};
    Renderer warm({.backend = GetParam(), .threads = 2, .gl_context = "osmesa"});
    const auto propagated = [&](std::size_t ran) {
      Renderer cold({.backend = GetParam(), .threads = 2, .gl_context = "osmesa"});
      const std::string told = warm.explain(work.scene, work.settings);
      const Frame frame = warm.render(work.scene, work.settings);
      EXPECT_EQ(frame.image("beauty").values, cold.render(work.scene, work.settings).image("beauty").values);
      std::map<bool, std::size_t> count;
      for (const StepStats& s : frame.stats.steps)
        if (s.name == "optical_depth_propagation") ++count[s.reused];
      std::printf("%s, %zu lights: %zu propagated, %zu kept\n", technique, work.scene.lights.size(), count[false], count[true]);
      EXPECT_EQ(count[false], ran) << technique;
      EXPECT_EQ(count[false] + count[true], work.scene.lights.size()) << technique;
      const bool kept = told.find("the optical depth from a light to everywhere (kept from the last frame") != std::string::npos;
      EXPECT_EQ(kept, ran == 0) << told;
    };
    propagated(4);
    const std::vector<LightSource> all = work.scene.lights;
    for (std::size_t k = 0; k < all.size(); ++k) {
      work.scene.lights = all;
      work.scene.lights.erase(work.scene.lights.begin() + static_cast<std::ptrdiff_t>(k));
      propagated(0);
      work.scene.lights.insert(work.scene.lights.begin(), all[k]);  // into the slot that it had, whose volume is still there
      propagated(0);
      work.scene.lights = all;
      propagated(0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, LightsGo, testing::Values("cpu", "gl"), [](const auto& p) { return p.param; });

// And the depths to Gaussians' centres that the published airlight reads, as uploads.
TEST(LightSlots, UploadsOfOthersAreTheSame) {
  Work work = small_work("gaussian-airlight");
  work.scene.lights = {small_lamp({2, 4, 1}), small_lamp({-3, 4, 1}), small_lamp({0, 5, -2})};
  work.set("light_path", "published");
  work.set("shadows", "off");
  const Technique& t = technique("gaussian-airlight");
  LightSlots slots;
  const auto uploads = [&] {
    FrameRequest request{
        .extent = *work.settings.resolution, .images = {"beauty"}, .knobs = KnobValues(t.knobs, work.settings.knobs)};
    slots = slots.after(work.scene.lights);
    request.light_slots = slots.numbers();
    std::map<Handle, std::uint64_t> keys;
    for (const Plan::Upload& u : t.plan(work.scene, request).uploads) keys[u.buffer] = u.key;
    return keys;
  };
  const auto before = uploads();
  work.scene.lights.erase(work.scene.lights.begin());
  const auto after = uploads();
  EXPECT_EQ(after.size() + 1, before.size());
  std::size_t changed = 0;
  for (const auto& [handle, key] : after) changed += before.contains(handle) && before.at(handle) == key ? 0 : 1;
  EXPECT_EQ(changed, 1U) << "light_to_camera, which is of all lights";
}

}  // namespace
}  // namespace airlight
