// The scenes that come with the program: each renders, and those with casters have shadows that matter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "app/airlight.h"
#include "common/scene/load.h"

namespace airlight {
namespace {

std::vector<std::string> scene_files() {
  std::vector<std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(AIRLIGHT_SCENES)) {
    if (entry.path().extension() == ".json") all.push_back(std::filesystem::relative(entry.path(), AIRLIGHT_SCENES).string());
  }
  std::sort(all.begin(), all.end());
  return all;
}

class SceneFiles : public testing::TestWithParam<std::string> {};

TEST_P(SceneFiles, Render) {
  const Scene scene = load_scene(AIRLIGHT_SCENES "/" + GetParam());
  Renderer renderer({.backend = "cpu"});
  RenderSettings settings;
  settings.resolution = Extent{48, 36};
  const HostImage image = renderer.render(scene, settings).image("beauty");
  double sum = 0;
  for (const float v : image.values) {
    ASSERT_TRUE(std::isfinite(v) && v >= 0) << v;
    sum += static_cast<double>(v);
  }
  EXPECT_GT(sum, 0);
  if (scene.technique != "shadow-planes") return;
  settings.knobs = {{"shadows", "off"}};
  const HostImage bright = renderer.render(scene, settings).image("beauty");
  double shadows = 0;
  for (std::size_t i = 0; i < bright.values.size(); ++i)
    shadows += std::fabs(static_cast<double>(bright.values[i]) - static_cast<double>(image.values[i]));
  std::printf("shadows change it by %.1f %%\n", 100 * shadows / sum);
  EXPECT_GT(shadows, 0.05 * sum);
}

INSTANTIATE_TEST_SUITE_P(Files, SceneFiles, testing::ValuesIn(scene_files()), [](const auto& test) {
  std::string name = test.param.substr(0, test.param.size() - 5);
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
});

}  // namespace
}  // namespace airlight
