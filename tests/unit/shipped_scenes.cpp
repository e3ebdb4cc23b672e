// Every scene in scenes/ loads and renders.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/airlight.h"

namespace airlight {
namespace {

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(AIRLIGHT_SCENES)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class ShippedScenes : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScenes, RendersAndItsCastersThrowShadows) {
  const Scene scene = load_scene(AIRLIGHT_SCENES "/" + GetParam() + ".json");
  Renderer renderer({.backend = "cpu"});
  RenderSettings settings;
  settings.resolution = Extent{96, 54};
  const Frame frame = renderer.render(scene, settings);
  const HostImage& beauty = frame.image("beauty");
  EXPECT_TRUE(std::all_of(beauty.values.begin(), beauty.values.end(), [](float v) { return v >= 0 && v < 1e30F; }));
  EXPECT_TRUE(std::any_of(beauty.values.begin(), beauty.values.end(), [](float v) { return v > 0; }));
  if (frame.technique != "shadow-planes") return;

  const bool casts = std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [](const Surface& s) { return s.casts_shadow; });
  settings.knobs = {{"shadows", "off"}};
  const Frame lit = renderer.render(scene, settings);
  EXPECT_EQ(lit.image("beauty").values != beauty.values, casts);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScenes, testing::ValuesIn(shipped_scenes()), [](const auto& test) { return test.param; });

}  // namespace
}  // namespace airlight
