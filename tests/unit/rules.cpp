// What a plan leaves out by a rule would not have changed the image: beside a scene that differs by as little as makes the rule
// not hold. Rules that have a test of their own are not here: docs/RESULTS.md names them all.
#include "common/plan/rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/plan/image_names.h"
#include "tests/unit/small_work.h"

namespace airlight {
namespace {

constexpr double almost_nothing = 1e-30;
constexpr float none = 1e-20F;  // of an image: what comes of that is far below it
constexpr float ended = 2e-6F;  // a march ends where a millionth of what is seen is left, which lights without effect may put off

class RuleOf : public testing::TestWithParam<std::string> {
 protected:
  bool holds(const Work& work, Rule rule) const {
    return explain(work.scene, work.settings).find("(" + std::string(name_of(rule)) + ")") != std::string::npos;
  }
  Frame render(const Work& work) { return renderer_.render(work.scene, work.settings); }
  std::vector<float> beauty(const Work& work) { return render(work).image("beauty").values; }
  // `bound`: of the difference beside the largest value.
  void leaves_image(Rule rule, const Work& lean, const Work& full, float bound) {
    EXPECT_TRUE(holds(lean, rule)) << explain(lean.scene, lean.settings);
    EXPECT_FALSE(holds(full, rule)) << explain(full.scene, full.settings);
    same_image(rule, lean, full, bound);
  }
  void same_image(Rule rule, const Work& lean, const Work& full, float bound) {
    const std::vector<float> a = beauty(lean), b = beauty(full);
    float largest = 0, worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      largest = std::max(largest, std::fabs(b[i]));
      worst = std::max(worst, std::fabs(a[i] - b[i]));
    }
    std::printf("%s: %g of the largest value\n", std::string(name_of(rule)).c_str(), static_cast<double>(worst / largest));
    EXPECT_GT(largest, 0);
    EXPECT_FALSE(!(worst <= bound * largest)) << name_of(rule);
  }

 private:
  Renderer renderer_{{.backend = GetParam(), .threads = 2, .gl_context = "osmesa"}};
};

TEST_P(RuleOf, LightsWay) {
  Work lean = small_work("marching");
  lean.scene.medium.ambient = {0.1, 0.2, 0.3};
  Work full = lean;
  lean.scene.lights.clear();
  for (LightSource& light : full.scene.lights) light.power = glm::dvec3(almost_nothing);
  leaves_image(Rule::no_light_march, lean, full, ended);
  lean.scene.surfaces[1].brdf = full.scene.surfaces[1].brdf = small_brdf();
  leaves_image(Rule::no_reflectances, lean, full, ended);
}

TEST_P(RuleOf, NodesOfGaussians) {
  Work lean = small_work("gaussian-airlight");
  lean.scene.medium.ambient = {0.1, 0.2, 0.3};
  lean.set("lost_depth", "1e-5");  // what Gaussians about lamps have anyway
  Work full = lean;
  lean.scene.lights.clear();
  for (LightSource& light : full.scene.lights) light.power = glm::dvec3(almost_nothing);
  leaves_image(Rule::no_nodes, lean, full, none);
  lean.scene.medium.gaussians[0].emission = {0.1, 0.1, 0.1};
  EXPECT_FALSE(holds(lean, Rule::no_nodes));
}

// A lamp that is near enough to be computed, and has nothing left at the camera, beside one that is left out.
TEST_P(RuleOf, LampsOutOfReach) {
  for (const char* technique : {"shadow-planes", "gaussian-airlight", "opacity-propagation", "marching"}) {
    Work full = small_work(technique);
    full.scene.medium.extinction = 10;
    full.scene.medium.ambient = {0.1, 0.2, 0.3};
    full.scene.lights[0].position = full.scene.camera.position + glm::dvec3(0, 0, -10);
    Work lean = full;
    lean.scene.lights[0].position.z -= 4;
    leaves_image(Rule::lamps_out_of_reach, lean, full, ended);
  }
}

// Its light is not computed where fog hides a surface, but its depth is there.
TEST_P(RuleOf, SurfacesBehindFog) {
  Work work = small_work("shadow-planes");
  work.set("indirect", "unbounded");
  work.settings.images = {"surface", "depth"};
  EXPECT_FALSE(holds(work, Rule::behind_fog));
  const auto values = [&](const char* name) { return render(work).image(name).values; };
  const std::vector<float> depth = values("depth"), lit = values("surface");
  EXPECT_GT(*std::max_element(lit.begin(), lit.end()), 0);
  work.scene.medium.extinction = 40;
  EXPECT_TRUE(holds(work, Rule::behind_fog));
  const std::vector<float> hidden = values("surface");
  EXPECT_EQ(*std::max_element(hidden.begin(), hidden.end()), 0);
  EXPECT_EQ(values("depth"), depth);
}

TEST_P(RuleOf, LightScatteredOntoSurfaces) {
  Work lean = small_work("shadow-planes");
  lean.set("indirect", "unbounded");
  Work full = lean;
  lean.scene.medium.albedo = glm::dvec3(0), full.scene.medium.albedo = glm::dvec3(almost_nothing);
  leaves_image(Rule::no_indirect, lean, full, none);
}

TEST_P(RuleOf, Environment) {
  Work lean = small_work("shadow-planes");
  lean.scene.environment = Environment{small_sky(), {0.3, 0.4, 0.5}, 20};
  Work full = lean;
  lean.scene.medium.extinction = 0, full.scene.medium.extinction = almost_nothing;
  leaves_image(Rule::environment_airlight, lean, full, none);
  lean.scene.medium.extinction = full.scene.medium.extinction = 0.1;
  lean.scene.medium.albedo = glm::dvec3(0), full.scene.medium.albedo = glm::dvec3(almost_nothing);
  lean.set("environment_indirect", "on"), full.set("environment_indirect", "on");
  leaves_image(Rule::environment_indirect, lean, full, none);
}

TEST_P(RuleOf, Gaussians) {
  for (const char* technique : {"gaussian-airlight", "opacity-propagation", "illumination-network", "marching"}) {
    Work full = small_work(technique);
    if (std::string(technique) == "opacity-propagation") full.set("density", "volume");  // of one albedo
    Work lean = full;
    Gaussian empty = small_blob({0, 0, 0});
    empty.extinction = 0, empty.albedo = {0.1, 0.2, 0.3};
    lean.scene.medium.gaussians.push_back(empty);
    lean.scene.medium.gaussians.insert(lean.scene.medium.gaussians.begin(), empty);
    leaves_image(Rule::empty_gaussians, lean, full, 0);
  }
}

// Beside the Gaussian that two of them are.
TEST_P(RuleOf, CoincidentGaussians) {
  for (const char* technique : {"gaussian-airlight", "opacity-propagation", "illumination-network", "marching"}) {
    Work full = small_work(technique), lean = full;
    std::vector<Gaussian>& two = lean.scene.medium.gaussians;
    two.front().extinction = 0.75, two.front().albedo = {0.5, 0.25, 1};
    two.push_back(two.front());
    two.back().extinction = 0.25, two.back().albedo = {1, 0.75, 0}, two.back().emission = {0.25, 0.5, 1};
    Gaussian& one = full.scene.medium.gaussians.front();
    one.extinction = 1, one.albedo = {0.625, 0.375, 0.75}, one.emission = {0.25, 0.5, 1};
    leaves_image(Rule::coincident_gaussians, lean, full, 0);
  }
}

TEST_P(RuleOf, FogAlone) {
  Work work = small_work("marching");
  work.scene.medium.gaussians.clear();
  EXPECT_TRUE(holds(work, Rule::homogeneous));
  Work other = work;
  other.set("light_steps", "16"), other.set("shadow", "march");
  same_image(Rule::homogeneous, work, other, 0);

  // A network whose Gaussians are none marches as marching does.
  work.scene.medium.gaussians = {small_blob({0, 0, 0})};
  work.scene.medium.gaussians[0].extinction = 0;
  Work network = small_work("illumination-network");
  network.scene = work.scene;
  EXPECT_TRUE(holds(network, Rule::no_network));
  same_image(Rule::no_network, network, work, 0);
}

// Beside frames that ask what each light scatters, for which every ray is computed; shadows fall on some tiles, or on none.
TEST(EvenAirlight, HasTheBitsOfEachRay) {
  Renderer renderer({.backend = "cpu", .threads = 2});
  for (const char* technique : {"shadow-planes", "marching"}) {
    for (const char* shadows : {"on", "off"}) {
      for (const bool sun : {true, false}) {
        Work work = small_work(technique);
        work.settings.resolution = Extent{200, 150};
        work.set("shadows", shadows);
        work.scene.medium.gaussians.clear();
        work.scene.medium.ambient = {0.1, 0.2, 0.3};
        work.scene.medium.emission = {0.01, 0.02, 0.03};
        work.scene.lights.erase(work.scene.lights.begin());
        if (!sun) work.scene.medium.phase = {PhaseKind::henyey_greenstein, 0.6}, work.scene.lights.clear();
        Work each = work;
        const bool computed = technique == std::string("shadow-planes") && sun && shadows == std::string("on");
        const std::vector<std::string> names = image_names(each.scene);
        const auto of_light = std::find_if(names.begin(), names.end(), [](const auto& n) { return n.starts_with("airlight."); });
        if (of_light != names.end()) each.settings.images.push_back(*of_light);
        const auto skipped = [&](const Frame& frame) {
          std::uint64_t sum = 0;
          for (const StepStats& s : frame.stats.steps)
            sum += s.name == "ray_march" || s.name == "homogeneous_airlight" ? s.skipped : 0;
          return sum;
        };
        const auto told = [](const Work& w) { return explain(w.scene, w.settings).find("(even-airlight)") != std::string::npos; };
        const Frame once = renderer.render(work.scene, work.settings);
        Renderer cold({.backend = "cpu", .threads = 2});
        const Frame all = cold.render(each.scene, each.settings);
        std::printf("%s, shadows %s, %s: %llu of 30000 pixels known, else %llu\n", technique, shadows, sun ? "a sun" : "no light",
                    static_cast<unsigned long long>(skipped(once)), static_cast<unsigned long long>(skipped(all)));
        EXPECT_EQ(once.image("beauty").values, all.image("beauty").values) << technique;
        EXPECT_EQ(told(work), !computed) << technique;
        EXPECT_EQ(skipped(once) > 1000, !computed) << technique;
        if (!sun) continue;
        EXPECT_FALSE(told(each)) << technique;
        EXPECT_EQ(skipped(all), 0U) << technique;
      }
    }
  }
}

// A Gaussian beside the rays shades the fog on them.
TEST(EvenAirlight, IsNotThereWhereGaussiansShadeFog) {
  Work work = small_work("marching");
  work.scene.lights.erase(work.scene.lights.begin());
  EXPECT_EQ(explain(work.scene, work.settings).find("(even-airlight)"), std::string::npos);
  work.scene.medium.gaussians.clear();
  EXPECT_NE(explain(work.scene, work.settings).find("(even-airlight)"), std::string::npos);
  work.scene.medium.phase = {PhaseKind::henyey_greenstein, 1e-6};
  EXPECT_EQ(explain(work.scene, work.settings).find("(even-airlight)"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Backends, RuleOf, testing::Values("cpu", "gl"), [](const auto& p) { return p.param; });

}  // namespace
}  // namespace airlight
