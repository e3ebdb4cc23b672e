// What of a frame of opacity-propagation is made again: only what changed, with the same bits as a cold render.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/airlight.h"

namespace airlight {
namespace {

Scene lit_blobs() {
  Scene scene;
  scene.camera.position = {0, 0.5, 5};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.resolution = {48, 36};
  scene.sky_distance = 30;
  for (int i = 0; i < 6; ++i) {
    scene.medium.gaussians.push_back({.center = {0.4 * i - 1, 0.1 * i, -0.2 * i}, .radius = 0.5, .extinction = 0.8});
  }
  for (const glm::dvec3 position : {glm::dvec3(2, 1, 1), glm::dvec3(-2, 2, 0)}) {
    LightSource lamp;
    lamp.position = position;
    lamp.power = {10, 8, 6};
    scene.lights.push_back(lamp);
  }
  return scene;
}

// How many steps of that name ran.
int ran(const Frame& frame, const std::string& name) {
  return static_cast<int>(std::count_if(frame.stats.steps.begin(), frame.stats.steps.end(),
                                        [&](const StepStats& s) { return s.name == name && !s.reused; }));
}

class PropagationReuse : public testing::TestWithParam<std::string> {
 protected:
  struct Runs {
    int injections, propagations, marches;
    bool operator==(const Runs&) const = default;
  };

  // Renders the scene on a warm renderer and on a cold one.
  Runs render(const Scene& scene) {
    RenderSettings settings;
    settings.technique = "opacity-propagation";
    settings.knobs = {{"resolution", "16"}, {"steps", "8"}};
    Renderer cold({.backend = GetParam()});
    const Frame frame = warm_.render(scene, settings);
    EXPECT_EQ(frame.image("beauty").values, cold.render(scene, settings).image("beauty").values);
    return {ran(frame, "density_injection"), ran(frame, "optical_depth_propagation"), ran(frame, "ray_march")};
  }

 private:
  Renderer warm_{{.backend = GetParam()}};
};

TEST_P(PropagationReuse, OnlyWhatChangedIsMadeAgain) {
  Scene scene = lit_blobs();
  EXPECT_EQ(render(scene), (Runs{1, 2, 1}));
  EXPECT_EQ(render(scene), (Runs{0, 0, 0})) << "nothing changed";
  scene.camera.position.x += 0.3;
  EXPECT_EQ(render(scene), (Runs{0, 0, 1})) << "the camera moved";
  scene.lights[1].position.y += 0.2;
  EXPECT_EQ(render(scene), (Runs{0, 1, 1})) << "a light moved";
  scene.lights[0].power *= 2.0;
  EXPECT_EQ(render(scene), (Runs{0, 0, 1})) << "a light is brighter";
  scene.medium.gaussians[2].extinction *= 1.5;
  EXPECT_EQ(render(scene), (Runs{1, 2, 1})) << "the medium changed";
  scene.medium.extinction = 0.05;
  EXPECT_EQ(render(scene), (Runs{0, 0, 1})) << "fog is not in the volumes";
}

INSTANTIATE_TEST_SUITE_P(Backends, PropagationReuse, testing::Values("cpu", "gl"), [](const auto& test) { return test.param; });

}  // namespace
}  // namespace airlight
