// What gaussian-airlight leaves out changes nothing, bit for bit; and what it says about it.
#include <gtest/gtest.h>

#include "app/airlight.h"
#include "common/techniques/technique.h"

namespace airlight {

namespace {

RenderSettings settings_of(const std::string& light_path = "exact") {
  RenderSettings settings;
  settings.technique = "gaussian-airlight";
  settings.resolution = Extent{96, 72};
  settings.knobs = {{"light_path", light_path}};
  return settings;
}

// Blobs before the camera, a lamp among them.
Scene blobs() {
  Scene scene;
  scene.camera = {.position = {0, 0, 5}, .look_at = {0, 0, 0}, .vertical_fov = 40};
  scene.sky_distance = 30;
  for (int i = 0; i < 5; ++i)
    scene.medium.gaussians.push_back({.center = {0.5 * i - 1, 0.2 * i - 0.4, -0.3 * i}, .radius = 0.4, .extinction = 1.2});
  LightSource lamp;
  lamp.position = {0.3, 0.8, 0.5};
  lamp.power = {5, 4, 3};
  scene.lights.push_back(lamp);
  return scene;
}

class GaussianSkips : public testing::TestWithParam<std::string> {
 protected:
  std::vector<float> beauty(const Scene& scene, const RenderSettings& settings = settings_of()) {
    return renderer.render(scene, settings).image("beauty").values;
  }
  Renderer renderer{{.backend = GetParam(), .gl_context = "osmesa"}};
};

TEST_P(GaussianSkips, OnesOutOfViewThatShadeNothing) {
  const Scene scene = blobs();
  Scene more = scene;
  more.medium.gaussians.push_back({.center = {0, 0.5, 9}, .radius = 0.6, .extinction = 2});
  more.medium.gaussians.push_back({.center = {-14, 0, 0}, .radius = 0.6, .extinction = 2});
  EXPECT_EQ(beauty(more), beauty(scene));
  EXPECT_NE(explain(more, settings_of()).find("rays through 2 Gaussians out of view"), std::string::npos)
      << explain(more, settings_of());
  EXPECT_EQ(explain(scene, settings_of()).find("out of view"), std::string::npos);
  more.lights[0].position = {0, 0.5, 13};  // now one of them stands before the lamp
  Scene less = scene;
  less.lights = more.lights;
  EXPECT_NE(beauty(more), beauty(less));
}

TEST_P(GaussianSkips, WhatIsNotThere) {
  const Scene scene = blobs();
  Scene more = scene;
  more.medium.gaussians.push_back({.center = {0, 0, 1}, .radius = 0.6, .extinction = 0});
  LightSource dark;
  dark.position = {1, 1, 1};
  dark.power = {0, 0, 0};
  more.lights.push_back(dark);
  more.medium.noise = {.amplitude = 0, .scale = 0.2};
  EXPECT_EQ(beauty(more), beauty(scene));
  const std::string told = explain(more, settings_of());
  EXPECT_NE(told.find("Gaussians of zero extinction"), std::string::npos) << told;
  EXPECT_NE(told.find("airlight tables: no homogeneous fog"), std::string::npos) << told;
  more.medium.noise.amplitude = 0.3;
  EXPECT_NE(beauty(more), beauty(scene));
}

// Rays that end before any Gaussian have none of their panels.
TEST_P(GaussianSkips, OnesBehindEverySurface) {
  Scene scene = blobs();
  auto wall = std::make_shared<Mesh>();
  wall->positions = {{-9, -9, 3.5F}, {9, -9, 3.5F}, {0, 12, 3.5F}};
  wall->normals.assign(3, {0, 0, 1});
  wall->triangles = {{0, 1, 2}};
  Surface surface;
  surface.mesh = wall;
  surface.casts_shadow = false;
  scene.surfaces = {surface};
  Scene none = scene;
  none.medium.gaussians.clear();
  RenderSettings settings = settings_of();
  settings.images = {"airlight"};
  const std::vector<float> with = renderer.render(scene, settings).image("airlight").values;
  EXPECT_EQ(with, renderer.render(none, settings).image("airlight").values);
}

// Volumes toward lights are kept while only the camera moves, and those of the other lights where one does.
TEST_P(GaussianSkips, DepthsTowardLightsThatStandStill) {
  Scene scene = blobs();
  LightSource second;
  second.position = {-2, 1, 1};
  second.power = {3, 3, 3};
  scene.lights.push_back(second);
  const auto propagated = [&] {
    const Frame frame = renderer.render(scene, settings_of("volume"));
    Renderer cold({.backend = GetParam(), .gl_context = "osmesa"});
    EXPECT_EQ(frame.image("beauty").values, cold.render(scene, settings_of("volume")).image("beauty").values);
    int made = 0;
    for (const StepStats& s : frame.stats.steps) made += s.name == "optical_depth_propagation" && !s.reused ? 1 : 0;
    return made;
  };
  EXPECT_EQ(propagated(), 2);
  scene.camera.position.x += 0.2;
  EXPECT_EQ(propagated(), 0) << "the camera moved";
  scene.lights[1].position.y += 0.2;
  EXPECT_EQ(propagated(), 1) << "a light moved";
  scene.medium.gaussians[0].extinction *= 2;
  EXPECT_EQ(propagated(), 2) << "the medium changed";
}

INSTANTIATE_TEST_SUITE_P(Backends, GaussianSkips, testing::Values("cpu", "gl"), [](const auto& p) { return p.param; });

}  // namespace

}  // namespace airlight
