#include <gtest/gtest.h>

#include "bench/pareto/sweep.h"

namespace airlight {
namespace {

TEST(Sweep, IsTheProductOfTheKnobsThatHaveOne) {
  std::vector<Knob> knobs(3);
  knobs[0].name = "a", knobs[0].sweep = {"1", "2", "3"};
  knobs[1].name = "b";
  knobs[2].name = "c", knobs[2].sweep = {"x", "y"};
  std::string all;
  for (const Settings& s : products(knobs)) all += text_of(s) + ";";
  EXPECT_EQ(all, "a=1 c=x;a=1 c=y;a=2 c=x;a=2 c=y;a=3 c=x;a=3 c=y;");
  EXPECT_EQ(products({}), std::vector<Settings>{{}});
  knobs[1].standard = "p", knobs[1].baselines = {"q"};
  knobs[0].sweep = {"1"}, knobs[0].baselines = {"0"};
  all.clear();
  for (const Settings& s : products(knobs, true)) all += text_of(s) + ";";
  EXPECT_EQ(all,
            "a=1 b=p c=x;a=1 b=p c=y;a=1 b=q c=x;a=1 b=q c=y;"
            "a=0 b=p c=x;a=0 b=p c=y;a=0 b=q c=x;a=0 b=q c=y;");
  EXPECT_EQ(products(knobs).size(), 2U);
}

TEST(Sweep, EveryValueIsOneThatItsKnobTakes) {
  for (const Technique& t : techniques()) {
    for (const Settings& s : products(t.knobs, true)) EXPECT_NO_THROW(KnobValues(t.knobs, s)) << t.name << ' ' << text_of(s);
  }
}

std::vector<Settings> different(const Technique& technique, const Scene& scene) {
  std::set<std::string> refused;
  const std::vector<Settings> settings = different_settings(technique, scene, {32, 24}, refused);
  EXPECT_TRUE(refused.empty());
  return settings;
}

Scene foggy() {
  Scene scene;
  scene.medium.extinction = 0.1;
  scene.lights.emplace_back();
  return scene;
}

TEST(Sweep, KnobsThatDoNothingAreLeftOut) {
  Scene scene = foggy();
  const Technique& marching = technique("marching");
  const std::size_t steps = marching.knobs[0].sweep.size();
  EXPECT_EQ(different(marching, scene).size(), steps);
  scene.medium.gaussians.emplace_back();
  // Marched toward the light with each number of steps, or by the closed form with none.
  EXPECT_EQ(different(marching, scene).size(), steps * (marching.knobs[1].sweep.size() + 1));
}

TEST(Sweep, ThePublishedOrderIsMeasuredWhereShadowsAreThrown) {
  Scene scene = foggy();
  const Technique& planes = technique("shadow-planes");
  const std::size_t nodes = planes.knobs[0].sweep.size();
  EXPECT_EQ(different(planes, scene).size(), nodes);
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{0, 0, -3}, {1, 0, -3}, {0, 0, -4}};
  mesh->normals.assign(3, {0, 1, 0});
  mesh->triangles = {{0, 1, 2}};
  scene.surfaces.emplace_back();
  scene.surfaces[0].mesh = mesh;
  EXPECT_EQ(different(planes, scene).size(), 2 * nodes);
  scene.surfaces[0].casts_shadow = false;
  EXPECT_EQ(different(planes, scene).size(), nodes);
}

// Once each way, whatever the other knobs; and not where it would leave shadows out.
TEST(Sweep, ThePublishedAirlightIsMeasuredWhereItRenders) {
  Scene scene = foggy();
  scene.medium.extinction = 0;
  scene.medium.gaussians.push_back({.center = {0, 0, -30}});  // a lamp within would keep all of its reach
  const auto published = [&](std::vector<std::string>& refused) {
    int count = 0;
    for (const Configuration& c : configurations(scene, {32, 24}, {"gaussian-airlight"}, {"cpu"}, refused))
      count += text_of(c.knobs).find("light_path=published") != std::string::npos ? 1 : 0;
    return count;
  };
  std::vector<std::string> refused;
  const std::size_t reaches = technique("gaussian-airlight").knobs[1].sweep.size();
  EXPECT_EQ(published(refused), static_cast<int>(2 * reaches)) << "by each error function";
  EXPECT_TRUE(refused.empty());
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{0, 0, -3}, {1, 0, -3}, {0, 0, -4}};
  mesh->normals.assign(3, {0, 1, 0});
  mesh->triangles = {{0, 1, 2}};
  scene.surfaces.emplace_back();
  scene.surfaces[0].mesh = mesh;
  EXPECT_EQ(published(refused), 0);
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_TRUE(refused[0].starts_with("gaussian-airlight: setting light_path: published")) << refused[0];
}

TEST(Sweep, ConfigurationsAreOfTechniquesThatRenderTheScene) {
  Scene scene = foggy();
  scene.technique = "marching";
  scene.settings = {{"steps", "77"}};
  std::vector<std::string> refused;
  for (const Configuration& c : configurations(scene, {32, 24}, {}, {"cpu", "gl"}, refused)) {
    EXPECT_NE(c.technique, "reference");
    EXPECT_EQ(c.all_knobs().size(), technique(c.technique).knobs.size()) << "the scene's own settings could win";
  }
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_TRUE(refused[0].starts_with("illumination-network: ")) << refused[0];  // nothing there for its particles
  refused.clear();
  const auto one = configurations(scene, {32, 24}, {"shadow-planes"}, {"gl"}, refused);
  ASSERT_FALSE(one.empty());
  EXPECT_EQ(one[0].technique + one[0].backend, "shadow-planesgl");
  scene.medium.gaussians.emplace_back();
  EXPECT_TRUE(configurations(scene, {32, 24}, {"shadow-planes"}, {"gl"}, refused).empty());
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_TRUE(refused[0].starts_with("shadow-planes: ")) << refused[0];
  EXPECT_TRUE(configurations(scene, {32, 24}, {"illumination-network"}, {"gl"}, refused).empty());
  EXPECT_NE(refused.back().find("above the first"), std::string::npos) << refused.back();
}

}  // namespace
}  // namespace airlight
