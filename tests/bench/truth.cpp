#include <gtest/gtest.h>

#include <cmath>

#include "bench/pareto/truth.h"
#include "common/scene/image_file.h"
#include "tests/unit/scene_folder.h"

namespace airlight {
namespace {

constexpr Extent extent{40, 20};

Scene foggy() {
  Scene scene;
  scene.medium.extinction = 0.1;
  LightSource lamp;
  lamp.position = {0.3, 0.2, -3};
  scene.lights = {lamp};
  return scene;
}

class TruthFolder : public testing::Test {
 protected:
  Truth truth(const Scene& scene, Extent e = extent, const Settings& set = {}) {
    NoProgress progress;
    return truth_of(scene, e, truth_knobs(scene, set), folder.path(), 2, progress);
  }
  std::string only(const std::string& extension) const {
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      if (entry.path().string().ends_with(extension)) return entry.path().string();
    }
    return {};
  }
  Folder folder;
};

TEST_F(TruthFolder, IsRenderedOnce) {
  const Scene scene = foggy();
  const Truth first = truth(scene), second = truth(scene);
  EXPECT_FALSE(first.kept);
  EXPECT_TRUE(second.kept);
  EXPECT_FALSE(first.black());
  EXPECT_EQ(first.beauty.values, second.beauty.values);
  EXPECT_EQ(first.edges, second.edges);
  EXPECT_EQ(first.edges.size(), 800U);
}

TEST_F(TruthFolder, AnotherSceneSettingOrExtentIsAnotherTruth) {
  Scene scene = foggy();
  truth(scene);
  scene.technique = "marching", scene.settings = {{"steps", "3"}}, scene.hash = "other", scene.camera.resolution = {7, 7};
  EXPECT_TRUE(truth(scene).kept) << "its image does not depend on these";
  EXPECT_FALSE(truth(scene, {20, 20}).kept);
  EXPECT_FALSE(truth(scene, extent, {{"shadows", "off"}}).kept);
  EXPECT_FALSE(truth(scene, extent, {{"tolerance", "1e-4"}}).kept);
  scene.lights[0].power *= 2;
  EXPECT_FALSE(truth(scene).kept);
}

TEST_F(TruthFolder, ADamagedOneIsRenderedAgain) {
  const Scene scene = foggy();
  truth(scene);
  std::filesystem::resize_file(only(".exr"), 300);
  EXPECT_FALSE(truth(scene).kept);
  EXPECT_TRUE(truth(scene).kept);
}

// As if the reference had been another one then.
TEST_F(TruthFolder, OneOfAnotherReferenceIsRenderedAgain) {
  const Scene scene = foggy();
  truth(scene);
  HostImage probe = read_image(only(".probe.pfm"));
  probe.values[0] *= 1.001F;
  write_image(only(".probe.pfm"), probe, {});
  EXPECT_FALSE(truth(scene).kept);
  EXPECT_TRUE(truth(scene).kept);
}

TEST(TruthKnobs, AreTheScenesThenTheCommandLines) {
  Scene scene;
  EXPECT_EQ(truth_knobs(scene, {}).number("tolerance"), 1e-6);
  scene.technique = "reference", scene.settings = {{"tolerance", "1e-4"}};
  EXPECT_EQ(truth_knobs(scene, {}).number("tolerance"), 1e-4);
  EXPECT_EQ(truth_knobs(scene, {{"tolerance", "1e-3"}}).number("tolerance"), 1e-3);
  EXPECT_THROW(truth_knobs(scene, {{"tolerances", "1e-3"}}), InputError);
}

TEST(RelativeError, IsRelativeToTheMean) {
  Truth truth{HostImage({2, 1}, 3), {false, true}};
  HostImage image({2, 1}, 3);
  for (std::size_t i = 0; i < 6; ++i) truth.beauty.values[i] = 2, image.values[i] = i < 3 ? 2.2F : 3;
  const RelativeError e = relative_error(image, truth);
  EXPECT_NEAR(e.off_edges, 0.1, 1e-6);
  EXPECT_NEAR(e.everywhere, std::sqrt((0.04 + 1) / 2) / 2, 1e-6);
  image.values[0] = NAN;
  EXPECT_TRUE(std::isinf(relative_error(image, truth).everywhere));
}

}  // namespace
}  // namespace airlight
