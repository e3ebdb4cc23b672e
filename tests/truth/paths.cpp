// Multiple scattering of the reference: its paths against its own quadrature where both are, against closed forms, and against
// walks that share nothing with them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <vector>

#include "common/formulas/double.h"
#include "tests/tolerances.h"
#include "tests/truth/null_collisions.h"
#include "tests/truth/path_scenes.h"

namespace airlight {

using namespace path_test;

namespace {

TEST(Paths, OneBounceIsTheQuadratures) {
  for (const Named& m : media()) {
    const ReferenceFrame truth = rendered(m.scene, settings(1, 2)), paths = rendered(m.scene, settings(1, 1500, true));
    expect_agree(m.name, spread(paths, truth));
    double each = 0;
    for (const ReferencePixel& p : paths.pixels) {
      glm::dvec3 sum(0);
      for (const glm::dvec3& light : p.airlight_of_light) sum += light;
      each = std::max(each, glm::length(sum - p.airlight) / glm::length(p.airlight));
    }
    EXPECT_LT(each, 1e-14);  // of each light alone
  }
}

// The comparison sees another phase function, and one channel's albedo that is off by 5 %.
TEST(Paths, ComparisonIsSharp) {
  for (const Named& m : {Named{"fog", fog()}, Named{"everything", everything()}}) {
    const ReferenceFrame truth = rendered(m.scene, settings(1, 2));
    Scene isotropic = m.scene, brighter = m.scene;
    isotropic.medium.phase = {};
    brighter.medium.albedo *= 1.05;
    for (Gaussian& g : brighter.medium.gaussians) g.albedo *= 1.05;
    if (brighter.medium.grid) brighter.medium.grid->albedo *= 1.05;
    const Spread phase = spread(rendered(isotropic, settings(1, 1500, true)), truth);
    const Spread albedo = spread(rendered(brighter, settings(1, 1500, true)), truth);
    std::printf("%s: chi-square %.0f where the phase function is another, %.0f where the albedo is\n", m.name, phase.chi,
                albedo.chi);
    EXPECT_GT(phase.chi, 1000);
    EXPECT_GT(albedo.chi, 48 + 5 * std::sqrt(2.0 * 48));
  }
}

// Light of the sun in fog without bounds is scattered n times by Henyey and Greenstein's function as once with g^n.
double sun_in_fog(double albedo, double g, int orders, double mu) {
  double sum = 0;
  for (int n = 1; n <= orders; ++n) sum += std::pow(albedo, n) * f64::phase_henyey_greenstein(std::pow(g, n), mu);
  return sum;
}

TEST(Paths, SunInFogWithoutBounds) {
  Scene scene = foggy_scene(0.7);
  scene.medium.albedo = glm::dvec3(0.9);
  scene.lights = {directional_light({0.3, -0.5, -0.8}, {1, 1, 1})};
  // Isotropic: each order is known without any randomness.
  for (const int orders : {1, 2, 3, 5}) {
    for (const bool single : {false, true}) {
      const ReferencePixel p = Reference(scene, settings(orders, 8, single)).pixel(centre, one_pixel);
      EXPECT_NEAR(p.airlight.y, sun_in_fog(0.9, 0, orders, 0), 1e-7) << orders;
      EXPECT_LT(p.standard_error.y, 1e-14);
    }
  }
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.8};
  const double mu = -glm::dot(scene.lights[0].direction, glm::dvec3(0, 0, -1));
  for (const int orders : {2, 4, 12, all_orders}) {
    const ReferencePixel p = Reference(scene, settings(orders, 60000)).pixel(centre, one_pixel);
    const double truth = sun_in_fog(0.9, 0.8, std::min(orders, 1000), mu), error = p.standard_error.y;
    std::printf("%d orders: %.6f, %.6f in closed form, apart %.2f standard errors of %.2g\n", orders, p.airlight.y, truth,
                (p.airlight.y - truth) / error, error);
    EXPECT_FALSE(!(std::fabs(p.airlight.y - truth) <= 4 * error));
    EXPECT_LT(error, 0.02 * truth);
    // As if light was scattered evenly, or with another g.
    EXPECT_GT(std::fabs(p.airlight.y - sun_in_fog(0.9, 0, std::min(orders, 1000), mu)), 8 * error);
    EXPECT_GT(std::fabs(p.airlight.y - sun_in_fog(0.9, 0.7, std::min(orders, 1000), mu)), 8 * error);
  }
}

// Lamps of which no place is so near that 1/r^2 of single walks would have no bounded variance.
TEST(Paths, AgreeWithNullCollisions) {
  constexpr int orders = 4, samples = 400;
  for (Named& m : media()) {
    for (LightSource& l : m.scene.lights) l.radius = 0.4;
    ReferenceFrame walks = rendered(m.scene, settings(1, 2));
    const ReferenceFrame paths = rendered(m.scene, settings(orders, samples));
    NullCollisions walk(m.scene, orders);
    double single = 0, more = 0;
    for (std::size_t i = 0; i < walks.pixels.size(); ++i) {
      const auto number = static_cast<std::uint32_t>(i);
      const auto width = static_cast<std::uint32_t>(small.width);
      const glm::dvec3 d = walk.direction({number % width + 0.5, number / width + 0.5}, small);
      double sum = 0, squares = 0;
      for (std::uint32_t k = 0; k < samples; ++k) {
        const double value = walk.sample(d, 2000000 + samples * number + k);
        sum += value, squares += value * value;
      }
      const double mean = sum / samples;
      single += walks.pixels[i].airlight.y, more += mean;
      walks.pixels[i].airlight.y += mean;
      walks.pixels[i].standard_error.y =
          std::hypot(std::sqrt((squares / samples - mean * mean) / (samples - 1)), paths.pixels[i].standard_error.y);
    }
    std::printf("twice or more often %.3f of once; ", more / single);
    EXPECT_GT(more, 0.1 * single);
    expect_agree(m.name, spread(walks, paths));
  }
}

// A closed box around camera, lamp and a part of the grid where it is constant: paths end at its walls, where both media have the
// same depths, so that the same random numbers make the same paths.
TEST(Paths, ConstantGridIsFogBetweenWalls) {
  Scene fog = foggy_scene(0.5);
  fog.medium.phase = {PhaseKind::henyey_greenstein, 0.4};
  fog.medium.albedo = {0.9, 0.8, 0.7};
  fog.lights = {point_light({1.5, 0.8, -3}, {10, 20, 30}), directional_light({0, -1, -0.2}, {1, 1, 1})};
  fog.surfaces = {surface(box({-3, -2, -6}, {3, 2, 1}), diffuse(0.5F, 0.6F, 0.7F), true)};
  Scene voxels = fog, both = fog;
  const glm::ivec3 size(10, 12, 20);
  GridMedium& g = voxels.medium.grid.emplace();
  g.voxels = std::make_shared<const VoxelGrid>(VoxelGrid{size, std::vector<float>(2400, 0.25F)});
  g.transform = glm::translate(glm::scale(glm::dmat4(1), glm::dvec3(2)), -0.5 * glm::dvec3(size));
  g.scale = 2, g.albedo = fog.medium.albedo;
  voxels.medium.extinction = 0;
  both.medium.extinction = 0.2, both.medium.grid = voxels.medium.grid, both.medium.grid->scale = 1.2;
  const ReferenceFrame truth = rendered(fog, settings(6, 50));
  for (const Scene* scene : {&voxels, &both}) {
    const ReferenceFrame frame = rendered(*scene, settings(6, 50));
    double worst = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
      const double error = std::fabs(frame.pixels[i].airlight.y - truth.pixels[i].airlight.y) / truth.pixels[i].airlight.y;
      if (!(error <= worst)) worst = error;
      EXPECT_GT(truth.pixels[i].standard_error.y, 0);
    }
    std::printf("largest relative difference %.2g\n", worst);
    EXPECT_FALSE(!(worst <= tolerance("paths_same_medium")));
  }
}

TEST(Paths, WallsBlockAndEndPaths) {
  Scene scene = gaussians();
  const auto airlight = [&](const Scene& s, bool shadows) {
    ReferenceSettings with = settings(4, 30, true);
    with.shadows = shadows;
    std::vector<double> values;
    for (const ReferencePixel& p : rendered(s, with).pixels) values.push_back(p.airlight.y);
    return values;
  };
  const std::vector<double> open = airlight(scene, true);
  // A box around the whole scene and its lamps, open to the sun in no place.
  Scene closed = scene;
  closed.lights.pop_back();
  const std::vector<double> lamps = airlight(closed, true);
  closed.lights = scene.lights;
  closed.surfaces = {surface(box(glm::dvec3(-200), glm::dvec3(200)), diffuse(0.5F, 0.5F, 0.5F), true)};
  const std::vector<double> boxed = airlight(closed, true);
  EXPECT_EQ(airlight(closed, false), open);
  closed.surfaces[0].casts_shadow = false;
  EXPECT_EQ(airlight(closed, true), open);
  double most = 0, sun = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    most = std::max(most, lamps[i]), sun = std::max(sun, open[i] - lamps[i]);
    EXPECT_NEAR(boxed[i], lamps[i], 1e-9 * lamps[i]);
  }
  EXPECT_GT(most, 0);
  EXPECT_GT(sun, 0.003 * most);
  // Lamps and sun behind a wall that goes on for ever: nothing comes through, in no order.
  Scene dark = scene;
  dark.lights = {point_light({0, 0, -9}, {100, 100, 100}), directional_light({0, -0.1, 1}, {1, 1, 1})};
  Mesh wall;
  add_parallelogram(wall, {-1e5, -1e5, -8}, {2e5, 0, 0}, {0, 2e5, 0});
  dark.surfaces = {surface(std::move(wall), diffuse(0, 0, 0), true)};
  for (const double v : airlight(dark, true)) EXPECT_EQ(v, 0);
  dark.surfaces.clear();
  for (const double v : airlight(dark, true)) EXPECT_GT(v, 0);
}

}  // namespace
}  // namespace airlight
