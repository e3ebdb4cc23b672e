// What hostile scenes have found, each as the least scene that shows it; on both backends, against the reference.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "app/airlight.h"
#include "tests/tolerances.h"
#include "tests/truth/relative_error.h"
#include "tests/truth/scenes.h"

namespace airlight {
namespace {

constexpr Extent extent{12, 8};
using Settings = std::vector<std::pair<std::string, std::string>>;

class Found : public testing::TestWithParam<std::string> {
 protected:
  void hold(const Scene& scene, const char* technique, const Settings& knobs, double bound) {
    NoProgress progress;
    const ReferenceFrame truth = reference_frame(scene, extent, {1e-6, true, Indirect::unbounded}, true, 2, progress);
    Renderer renderer({.backend = GetParam(), .gl_context = "osmesa"});
    RenderSettings settings;
    settings.technique = technique, settings.knobs = knobs, settings.resolution = extent;
    const double error = relative_error(renderer.render(scene, settings).image("beauty"), truth, parts[0]).off_edges;
    std::printf("%s on %s: relative RMSE %.3g, allowed %.3g\n", technique, GetParam().c_str(), error, bound);
    EXPECT_FALSE(!(error <= bound)) << technique;
  }
};

Scene steam() {
  Scene scene;
  scene.medium.gaussians.push_back({.center = {0, 0, -4}, .radius = 1, .extinction = 0.3});
  scene.lights = {point_light({1, 2, -4}, glm::dvec3(10))};
  return scene;
}

// Rays to it are longer than those that hit nothing.
TEST_P(Found, ASurfaceBeyondTheSky) {
  Scene scene = steam();
  scene.surfaces = {black_wall(-8)};
  for (const double fog : {0.0, 0.05}) {
    scene.sky_distance = 1, scene.medium.extinction = fog;
    hold(scene, "gaussian-airlight", {{"samples", "8"}}, tolerance("truth_gaussians_fine"));
  }
}

// Half the light of such a lamp is scattered within a few of its radii, and is seen through nothing.
TEST_P(Found, ALampInTheCamera) {
  Scene scene = steam();
  scene.medium.gaussians[0].center = {0, 0, -1}, scene.medium.gaussians[0].extinction = 1;
  scene.lights = {point_light({0, 0, 0}, glm::dvec3(1))};
  for (const char* technique : {"marching", "opacity-propagation"})
    hold(scene, technique, {{"steps", "64"}}, tolerance("stress_headlight"));
}

INSTANTIATE_TEST_SUITE_P(Backends, Found, testing::Values("cpu", "gl"), [](const auto& p) { return p.param; });

}  // namespace
}  // namespace airlight
