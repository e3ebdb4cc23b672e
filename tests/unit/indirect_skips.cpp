// What light that scatters onto surfaces is left out, what is said about it, and what is refused.
#include <gtest/gtest.h>

#include "app/airlight.h"
#include "common/error.h"
#include "common/techniques/technique.h"
#include "tests/parity/inputs.h"

namespace airlight {
namespace {

Scene floor_under_lamp() {
  Scene scene;
  scene.camera = {.position = {0, 3, 3}, .look_at = {0, 0, 0}};
  scene.medium.extinction = 0.1;
  LightSource lamp;
  lamp.position = {0, 2, 0}, lamp.power = {5, 4, 3};
  scene.lights = {lamp};
  Surface floor;
  floor.mesh = square(4);
  scene.surfaces = {floor};
  return scene;
}

Scene with_blob(Scene scene, const glm::dvec3& albedo) {
  scene.medium.gaussians = {{.center = {0, 1, 0}, .radius = 0.5, .extinction = 1, .albedo = albedo}};
  return scene;
}

RenderSettings settings_of(const std::string& indirect, const std::string& of_environment = "off") {
  RenderSettings settings;
  settings.technique = "gaussian-airlight";
  settings.resolution = Extent{12, 9};
  settings.knobs = {{"indirect", indirect}, {"environment_indirect", of_environment}};
  return settings;
}

bool told(const Scene& scene, const RenderSettings& settings, const std::string& what) {
  const std::string all = explain(scene, settings);
  if (all.find(what) != std::string::npos) return true;
  std::printf("%s\n", all.c_str());
  return false;
}

TEST(IndirectSkips, SayWhy) {
  const std::string rest = "light that Gaussians and grids scatter onto surfaces: ";
  EXPECT_TRUE(told(floor_under_lamp(), settings_of("mean_density"), rest + "there is none"));
  EXPECT_TRUE(told(with_blob(floor_under_lamp(), {0, 0, 0}), settings_of("mean_density"), rest + "they absorb all"));
  EXPECT_TRUE(told(with_blob(floor_under_lamp(), {0, 0, 0}), settings_of("psf"), rest + "they absorb all"));
  Scene bare = with_blob(floor_under_lamp(), {1, 1, 1});
  bare.surfaces.clear();
  EXPECT_TRUE(told(bare, settings_of("psf"), "indirect single scattering: no light, no surface or nothing scatters"));

  Scene lit = floor_under_lamp();
  lit.environment = Environment{nullptr, {1, 1, 1}, 0};
  const std::string environment = "indirect light of the environment: ";
  EXPECT_TRUE(told(lit, settings_of("off"), environment + "environment_indirect = off"));
  EXPECT_TRUE(told(lit, settings_of("off", "published"), environment + "no Gaussian and no grid scatters"));
  lit.medium.albedo = {0, 0, 0};
  EXPECT_TRUE(told(lit, settings_of("off", "on"), environment + "nothing scatters"));
  EXPECT_TRUE(told(with_blob(lit, {0, 0, 0}), settings_of("off", "on"), environment + "nothing scatters"));
  bare.environment = lit.environment;
  EXPECT_TRUE(told(bare, settings_of("off", "on"), environment + "no surface"));
}

// Bit for bit: Gaussians that absorb all scatter nothing onto surfaces, whatever is asked for.
TEST(IndirectSkips, ChangeNothing) {
  Renderer renderer({.backend = "cpu"});
  Scene scene = with_blob(floor_under_lamp(), {0, 0, 0});
  scene.environment = Environment{nullptr, {1, 1, 1}, 0};
  const auto beauty = [&](const std::string& indirect, const std::string& of_environment) {
    return renderer.render(scene, settings_of(indirect, of_environment)).image("beauty").values;
  };
  EXPECT_EQ(beauty("mean_density", "published"), beauty("unbounded", "off"));
  EXPECT_NE(beauty("unbounded", "on"), beauty("unbounded", "off"));
  scene = with_blob(scene, {1, 1, 1});
  EXPECT_NE(beauty("mean_density", "off"), beauty("unbounded", "off"));
  EXPECT_NE(beauty("psf", "off"), beauty("unbounded", "off"));
  EXPECT_NE(beauty("unbounded", "published"), beauty("unbounded", "off"));
}

TEST(IndirectSkips, PointSpreadFunctionIsOfTheIsotropicPhase) {
  Scene scene = with_blob(floor_under_lamp(), {1, 1, 1});
  scene.environment = Environment{nullptr, {1, 1, 1}, 0};
  scene.medium.phase = {PhaseKind::rayleigh, 0};
  EXPECT_THROW(explain(scene, settings_of("psf")), InputError);
  EXPECT_THROW(explain(scene, settings_of("off", "published")), InputError);
  EXPECT_NO_THROW(explain(scene, settings_of("mean_density", "on")));
}

}  // namespace
}  // namespace airlight
