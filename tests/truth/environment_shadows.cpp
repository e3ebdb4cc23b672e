// What surfaces hide of an environment: the reference against closed forms, techniques against both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>

#include "app/airlight.h"
#include "common/reference/reference.h"
#include "common/scene/brdf.h"
#include "tests/parity/brdfs.h"
#include "tests/parity/inputs.h"
#include "tests/tolerances.h"
#include "tests/truth/relative_error.h"
#include "tests/truth/scenes.h"

namespace airlight {
namespace {

// Brighter upward and toward -X, coloured.
Environment evening() {
  constexpr Extent extent{16, 8};
  auto image = std::make_shared<HostImage>(extent, 3);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const double up = 1 - 2 * (y + 0.5) / extent.height, west = std::cos(2 * std::numbers::pi * (x + 0.5 - 4) / extent.width);
      for (int c = 0; c < 3; ++c)
        image->at(x, y, c) = static_cast<float>(0.4 + 0.3 * up + (1 - up * up) * std::max(west, 0.0) * (1.5 - 0.4 * c));
    }
  }
  return {image, {1, 1, 1}, 0};
}

// A torus above a floor of two triangles, under that sky.
Scene torus_above_floor(float specular, double roughness) {
  Scene scene;
  scene.environment = evening();
  scene.camera.position = {1.5, 2.2, 3.2}, scene.camera.look_at = {0, 0.3, 0};
  Material material = diffuse(0.7F, 0.6F, 0.5F);
  material.specular = glm::vec3(specular), material.shininess = 10;
  Surface torus;
  torus.mesh = wavy_torus(500);
  torus.transform[3] = glm::dvec4(0, 0.6, 0, 1);
  torus.material = material;
  Mesh floor;
  add_parallelogram(floor, {-6, 0, 5}, {11, 0, 0}, {0, 0, -13});
  scene.surfaces = {torus, surface(std::move(floor), material, true)};
  if (!(roughness > 0)) return scene;
  const auto brdf = microfacet_table({40, 24, 32}, roughness);
  for (Surface& s : scene.surfaces) s.brdf = brdf, s.material = brdf_material(*brdf);
  return scene;
}

double error(const Scene& scene, const ReferenceFrame& truth, Renderer& renderer, const char* shadows) {
  RenderSettings settings;
  settings.technique = "gaussian-airlight";
  settings.resolution = truth.extent;
  settings.images = {"surface"};
  settings.knobs = {{"environment_shadows", shadows}};
  const Frame frame = renderer.render(scene, settings);
  RelativeRmse e;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    for (int c = 0; c < 3 && !truth.edges[i]; ++c) {
      if (truth.pixels[i].surface_index < 0) continue;
      e.add(static_cast<double>(frame.image("surface").values[3 * i + static_cast<std::size_t>(c)]), truth.pixels[i].surface[c]);
    }
  }
  return e.value();
}

struct Look {
  std::string_view name, bound;
  float specular;
  double roughness = 0;  // of a table of microfacets, which it is then
};
void PrintTo(const Look& l, std::ostream* out) { *out << l.name; }

class EnvironmentShadows : public testing::TestWithParam<Look> {};

TEST_P(EnvironmentShadows, StateTheDistance) {
  const Scene scene = torus_above_floor(GetParam().specular, GetParam().roughness);
  NoProgress progress;
  const ReferenceFrame truth = reference_frame(scene, {12, 9}, {}, true, 2, progress);
  std::printf("truth claims %.1e\n", truth.error);
  for (const char* backend : {"cpu", "gl"}) {
    Renderer renderer({.backend = backend});
    const double on = error(scene, truth, renderer, "on"), off = error(scene, truth, renderer, "off");
    std::printf("%s: relative RMSE on surfaces %.2f %% with shadows, %.2f %% without\n", backend, 100 * on, 100 * off);
    EXPECT_FALSE(!(on <= tolerance(GetParam().bound)));
    EXPECT_GT(off, 4 * on);
  }
}

INSTANTIATE_TEST_SUITE_P(Looks, EnvironmentShadows,
                         testing::Values(Look{"matt", "environment_shadows_matt", 0},
                                         Look{"glossy", "environment_shadows_glossy", 0.4F},
                                         Look{"tabulated_rough", "environment_shadows_rough_table", 0, 0.6},
                                         Look{"tabulated", "environment_shadows_table", 0, 0.3}),
                         [](const auto& test) { return std::string(test.param.name); });

// A floor beside a wall without end that is 1 m high: at x from it a white sky lights (1 + x / sqrt(x^2 + 1)) / 2 of what it
// would without (form factor of a strip without end). The wall stands on one edge of a floor of two triangles.
TEST(EnvironmentShadowsOfAWall, HaveAClosedForm) {
  Scene scene;
  scene.environment = Environment{nullptr, {2, 2, 2}, 0};
  Mesh wall, floor;
  add_parallelogram(wall, {-40, 0, 0}, {80, 0, 0}, {0, 1, 0});
  add_parallelogram(floor, {-1.5, 0, 4}, {3, 0, 0}, {0, 0, -4});
  scene.surfaces = {surface(wall, diffuse(0, 0, 0), true), surface(floor, diffuse(0.5F, 0.5F, 0.5F), true)};
  scene.camera.up = {0, 0, -1};
  Renderer cpu({.backend = "cpu"});
  for (const double x : {0.05, 0.2, 0.5, 1.0, 2.0, 3.5}) {
    scene.camera.position = {0.1, 0.04, x}, scene.camera.look_at = {0.1, 0, x};
    const double expected = (1 + x / std::sqrt(x * x + 1)) / 2;
    const ReferencePixel truth = Reference(scene).pixel(centre, one_pixel, {true, false});
    RenderSettings settings;
    settings.resolution = one_pixel;
    settings.images = {"surface"};
    const double found = static_cast<double>(cpu.render(scene, settings).image("surface").at(0, 0, 0));
    std::printf("%g m from the wall: %.4f, reference %.4f, closed form %.4f\n", x, found, truth.surface.x, expected);
    EXPECT_FALSE(!(std::fabs(truth.surface.x - expected) <= tolerance("environment_shadows_reference")));
    EXPECT_FALSE(!(std::fabs(found - expected) <= tolerance("environment_shadows_wall")));
  }
}

// In a closed box no light is.
TEST(EnvironmentShadowsInABox, AreComplete) {
  Scene scene;
  scene.environment = evening();
  Material material = diffuse(0.5F, 0.5F, 0.5F);
  scene.surfaces = {surface(box({-1, -1, -1}, {1, 1, 1}), material, true)};
  scene.camera.position = {0.2, 0.3, 0.1}, scene.camera.look_at = {0.1, -0.3, -1};
  const Extent extent{8, 6};
  NoProgress progress;
  const ReferenceFrame truth = reference_frame(scene, extent, {}, false, 2, progress);
  for (const ReferencePixel& p : truth.pixels) EXPECT_EQ(p.surface, glm::dvec3(0));
  RenderSettings settings;
  settings.resolution = extent;
  settings.images = {"surface"};
  Renderer cpu({.backend = "cpu"});
  const Frame frame = cpu.render(scene, settings);
  double worst = 0;
  for (const float v : frame.image("surface").values) worst = std::max(worst, static_cast<double>(v));
  std::printf("at most %.2g\n", worst);
  EXPECT_FALSE(!(worst <= tolerance("environment_shadows_box")));
}

}  // namespace
}  // namespace airlight
