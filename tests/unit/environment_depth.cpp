// Mean depths about surfaces: which are found where, and what of them is kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "app/airlight.h"
#include "tests/parity/inputs.h"
#include "tests/unit/small_work.h"

namespace airlight {
namespace {

Scene steam_over_a_square(int gaussians) {
  Scene scene;
  scene.camera = {.position = {0, 2, 5}, .look_at = {0, 0, 0}, .vertical_fov = 40};
  scene.camera.resolution = {64, 48};
  for (int i = 0; i < gaussians; ++i) {
    scene.medium.gaussians.push_back(
        {.center = {std::sin(2.4 * i), 0.1 + 0.05 * i, std::cos(2.4 * i)}, .radius = 0.7, .extinction = 0.2});
  }
  Surface ground;
  ground.mesh = square(1.5);
  ground.casts_shadow = false;
  scene.surfaces = {ground};
  scene.environment = Environment{nullptr, {1, 2, 3}, 0};
  return scene;
}

RenderSettings settings_of(const char* choice) {
  RenderSettings settings;
  settings.technique = "gaussian-airlight";
  settings.knobs = {{"environment_depth", choice}};
  return settings;
}

bool ran(const Frame& frame, std::string_view name) {
  return std::any_of(frame.stats.steps.begin(), frame.stats.steps.end(),
                     [&](const StepStats& s) { return s.name == name && !s.reused; });
}

bool finds_on_lattices(const Scene& scene, const RenderSettings& settings) {
  const std::string told = explain(scene, settings);
  const bool skipped = told.find("(no-depth-lattice)") != std::string::npos;
  EXPECT_NE(told.find("optical depths over all directions from places about the surfaces") != std::string::npos, skipped) << told;
  return !skipped;
}

TEST(EnvironmentDepthPlan, TakesLatticesWhereTheyAreFaster) {
  const Scene many = steam_over_a_square(17);
  EXPECT_TRUE(finds_on_lattices(many, settings_of("auto")));
  EXPECT_TRUE(finds_on_lattices(many, settings_of("lattice")));
  EXPECT_TRUE(finds_on_lattices(many, settings_of("object")));
  EXPECT_FALSE(finds_on_lattices(many, settings_of("pixel")));
  EXPECT_FALSE(finds_on_lattices(steam_over_a_square(16), settings_of("auto")));
  Scene small = many;
  small.medium.gaussians[0].radius = 0.03, small.medium.gaussians[0].extinction = 5;
  EXPECT_FALSE(finds_on_lattices(small, settings_of("auto")));
  small.medium.gaussians[0].radius = 1e-5, small.medium.gaussians[0].extinction = 1e4;
  EXPECT_FALSE(finds_on_lattices(small, settings_of("auto")));
  EXPECT_THROW(explain(small, settings_of("lattice")), InputError);
}

class EnvironmentDepths : public testing::TestWithParam<std::string> {
 protected:
  Frame render(const Scene& scene, const char* choice) {
    Renderer cold({.backend = GetParam(), .gl_context = "osmesa"});
    Frame frame = warm_.render(scene, settings_of(choice));
    EXPECT_EQ(frame.image("beauty").values, cold.render(scene, settings_of(choice)).image("beauty").values);
    return frame;
  }

 private:
  Renderer warm_{{.backend = GetParam(), .gl_context = "osmesa"}};
};

TEST_P(EnvironmentDepths, AreKeptWhileTheCameraMoves) {
  Scene scene = steam_over_a_square(20);
  EXPECT_TRUE(ran(render(scene, "auto"), "mean_depth_lattice"));
  scene.camera.position.x += 0.3;
  EXPECT_FALSE(ran(render(scene, "auto"), "mean_depth_lattice"));
  scene.medium.gaussians[3].center.y += 0.1;
  EXPECT_TRUE(ran(render(scene, "auto"), "mean_depth_lattice"));
  scene.surfaces[0].transform[3].y += 0.2;
  EXPECT_TRUE(ran(render(scene, "auto"), "mean_depth_lattice"));
}

TEST_P(EnvironmentDepths, OfAGridAreKeptWhileTheCameraMoves) {
  Scene scene = steam_over_a_square(0);
  scene.medium.grid = small_grid();
  scene.medium.grid->transform = glm::scale(scene.medium.grid->transform, glm::dvec3(0.5));
  RenderSettings settings = settings_of("lattice");
  settings.technique = "marching";
  Renderer renderer({.backend = GetParam(), .gl_context = "osmesa"});
  const auto runs = [&] { return ran(renderer.render(scene, settings), "mean_depth_lattice"); };
  EXPECT_TRUE(runs());
  scene.camera.position.x += 0.3;
  EXPECT_FALSE(runs());
  scene.medium.grid->albedo = {0.5, 0.6, 0.7};
  EXPECT_FALSE(runs());
  scene.medium.grid->scale *= 2;
  EXPECT_TRUE(runs());
}

// About a Gaussian in the middle of a square the depth is its own there, sqrt(pi) / 2 extinction radius, and so by `object` all
// over the square.
TEST_P(EnvironmentDepths, OfAnObjectIsThatOfItsMiddle) {
  Scene scene = steam_over_a_square(0);
  scene.medium.gaussians = {{.center = {0, 0, 0}, .radius = 0.3, .extinction = 2}};
  RenderSettings settings = settings_of("object");
  settings.images = {"surface.environment", "transmittance"};
  Renderer renderer({.backend = GetParam(), .gl_context = "osmesa"});
  const Frame frame = renderer.render(scene, settings);
  const auto diffuse = static_cast<double>(scene.surfaces[0].material.diffuse.x);
  const double expected = diffuse * std::exp(-0.6 * 0.88622692545275801);
  int seen = 0;
  for (const auto& [x, y] : {std::pair(32, 24), std::pair(24, 28), std::pair(40, 22)}) {
    const double light = static_cast<double>(frame.image("surface.environment").at(x, y, 0)),
                 through = static_cast<double>(frame.image("transmittance").at(x, y, 0));
    seen += through < 1;
    EXPECT_NEAR(light / through, expected, 1e-5) << x << " " << y;
  }
  EXPECT_GT(seen, 0);
}

INSTANTIATE_TEST_SUITE_P(Backends, EnvironmentDepths, testing::Values("cpu", "gl"), [](const auto& test) { return test.param; });

}  // namespace
}  // namespace airlight
