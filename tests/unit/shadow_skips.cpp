// What ShadowPlanes leaves out changes nothing, bit for bit; and what it says about it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>

#include "app/airlight.h"
#include "common/relative_rmse.h"
#include "tests/parity/inputs.h"
#include "tests/tolerances.h"

namespace airlight {

namespace {

HostImage beauty(Renderer& renderer, const Scene& scene, const std::string& shadows = "on",
                 const std::string& technique = "shadow-planes") {
  RenderSettings settings;
  settings.technique = technique;
  settings.resolution = Extent{160, 120};
  settings.knobs = {{"shadows", shadows}};
  return renderer.render(scene, settings).image("beauty");
}

class ShadowSkips : public testing::TestWithParam<std::string> {
 protected:
  Renderer renderer{{.backend = GetParam(), .gl_context = "osmesa"}};
};

TEST_P(ShadowSkips, NothingThatCastsIsAsShadowsOff) {
  Scene scene = test_scene(600);
  for (Surface& s : scene.surfaces) s.casts_shadow = false;
  EXPECT_EQ(beauty(renderer, scene).values, beauty(renderer, scene, "off").values);
  EXPECT_NE(explain(scene, {}).find("shadow planes: nothing casts a shadow"), std::string::npos) << explain(scene, {});
  for (Surface& s : scene.surfaces) s.casts_shadow = true;
  EXPECT_NE(beauty(renderer, scene).values, beauty(renderer, scene, "off").values);
}

// In uneven media the lit parts are made, or not, by the kernels themselves.
TEST_P(ShadowSkips, NothingThatCastsInUnevenMedia) {
  for (const std::string technique : {"marching", "gaussian-airlight"}) {
    RenderSettings settings;
    settings.technique = technique;
    Scene scene = test_scene(600);
    scene.medium.gaussians = {{.center = {0.2, 0.1, 0}, .radius = 0.6, .extinction = 0.8}};
    EXPECT_NE(beauty(renderer, scene, "on", technique).values, beauty(renderer, scene, "off", technique).values) << technique;
    EXPECT_NE(explain(scene, settings).find("shadow_planes"), std::string::npos) << explain(scene, settings);
    for (Surface& s : scene.surfaces) s.casts_shadow = false;
    EXPECT_EQ(beauty(renderer, scene, "on", technique).values, beauty(renderer, scene, "off", technique).values) << technique;
    EXPECT_NE(explain(scene, settings).find("shadow planes: nothing casts a shadow"), std::string::npos)
        << explain(scene, settings);
    // Far above the lamp: no ray crosses its planes.
    scene.lights.resize(1);
    scene.surfaces[1].casts_shadow = true;
    scene.surfaces[1].transform[3] = {0, 50, 0, 1};
    EXPECT_NE(explain(scene, settings).find("shadow_planes"), std::string::npos) << explain(scene, settings);
    const HostImage on = beauty(renderer, scene, "on", technique), off = beauty(renderer, scene, "off", technique);
    if (technique == "marching") {
      EXPECT_EQ(on.values, off.values);
      continue;
    }
    // With volumes, depths along the ray are closed forms whatever crosses it.
    RelativeRmse difference;
    for (std::size_t i = 0; i < on.values.size(); ++i)
      difference.add(static_cast<double>(on.values[i]), static_cast<double>(off.values[i]));
    std::printf("%s, planes that nothing crosses: %.4f %% beside none\n", technique.c_str(), 100 * difference.value());
    EXPECT_FALSE(!(difference.value() < tolerance("depths_of_the_nodes")));
  }
}

TEST_P(ShadowSkips, LightsOfNoPowerThrowNoShadow) {
  Scene scene = test_scene(600);
  const HostImage before = beauty(renderer, scene);
  LightSource dark = scene.lights[0];
  dark.name = "dark";
  dark.power = glm::dvec3(0);
  scene.lights.push_back(dark);
  EXPECT_EQ(beauty(renderer, scene).values, before.values);
  EXPECT_NE(explain(scene, {}).find("lights of zero power"), std::string::npos);
}

// In fog of 40 /m the light at 2.5 m and more is below any float.
TEST_P(ShadowSkips, CastersOutOfReach) {
  Scene scene = test_scene(600);
  scene.medium.extinction = 40;
  scene.lights.resize(1);
  scene.lights[0].position = scene.camera.position + glm::dvec3(0, 0.1, -0.3);
  EXPECT_EQ(beauty(renderer, scene).values, beauty(renderer, scene, "off").values);
  EXPECT_NE(explain(scene, {}).find("out of reach"), std::string::npos) << explain(scene, {});
}

// A torus behind a wall and one behind the camera: their planes lie behind every surface, or out of view.
TEST_P(ShadowSkips, PlanesThatNoRayMeets) {
  Scene scene = test_scene(600);
  scene.camera.position = {0, 0, 4};
  scene.camera.look_at = {0, 0, 0};
  scene.lights.resize(1);
  scene.lights[0].position = {0.5, 0.7, 3};
  Surface wall{.mesh = square(30), .material = {.diffuse = {0.5F, 0.5F, 0.5F}}};
  wall.transform = glm::dmat4(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1);  // y = 0 becomes z = 0
  Surface torus = scene.surfaces[1];
  scene.surfaces = {wall};
  const HostImage before = beauty(renderer, scene);
  torus.transform[3] = {0, 0, -3, 1};
  scene.surfaces.push_back(torus);
  EXPECT_EQ(beauty(renderer, scene).values, before.values) << "behind the wall";
  scene.surfaces[1].transform[3] = {0, 0, 9, 1};
  EXPECT_EQ(beauty(renderer, scene).values, before.values) << "behind the camera";
  scene.surfaces[1].transform[3] = {0, 0, 1, 1};
  EXPECT_NE(beauty(renderer, scene).values, before.values) << "in view it does throw a shadow";
}

// A torus in open fog, whose planes end nowhere: in the tiles that explain() counts shadows change no pixel. It may
// miss some: a plane is listed where its borders, each by itself, may reach into a row of tiles.
TEST(ShadowTiles, ThoseWithoutPlanesAreCounted) {
  Scene scene = test_scene(600);
  scene.camera.position = {0, 0, 4};
  scene.camera.look_at = {0, 0, 0};
  scene.lights.resize(1);
  scene.lights[0].position = {-1.5, 0.9, 0.5};
  scene.medium.extinction = 0.01;
  scene.sky_distance = std::numeric_limits<double>::infinity();
  scene.surfaces = {scene.surfaces[1]};
  scene.surfaces[0].transform = glm::dmat4(0.3);
  scene.surfaces[0].transform[3] = {0, 0, 0, 1};
  RenderSettings settings;
  settings.technique = "shadow-planes";
  settings.resolution = Extent{448, 330};
  Renderer renderer{{.backend = "cpu"}};
  const auto airlight = [&](const char* shadows) {
    settings.images = {"airlight"};
    settings.knobs = {{"shadows", shadows}};
    return renderer.render(scene, settings).image("airlight");
  };
  const HostImage with = airlight("on"), without = airlight("off");
  int same = 0;
  for (int y = 0; y < 330; y += 64) {
    for (int x = 0; x < 448; x += 64) {
      bool differs = false;
      for (int j = y; j < std::min(y + 64, 330); ++j) {
        for (int i = x; i < x + 64; ++i) differs |= with.at(i, j, 0) != without.at(i, j, 0);
      }
      same += !differs;
    }
  }
  EXPECT_GT(same, 4);
  EXPECT_LT(same, 38);
  settings.knobs = {{"shadows", "on"}};
  const std::string told = explain(scene, settings), before = "shadow planes in ";
  const std::size_t at = told.find(before);
  ASSERT_NE(at, std::string::npos) << told;
  EXPECT_NE(told.find(" of 42 tiles of 64 x 64 pixels", at), std::string::npos) << told;
  const int counted = std::stoi(told.substr(at + before.size()));
  std::printf("%d tiles counted, %d without a changed pixel\n", counted, same);
  EXPECT_LE(counted, same);
  EXPECT_GT(counted, same / 2);
  settings.knobs = {{"shadows", "off"}};
  EXPECT_EQ(explain(scene, settings).find("tiles"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Backends, ShadowSkips, testing::Values("cpu", "gl"), [](const auto& p) { return p.param; });

}  // namespace

}  // namespace airlight
