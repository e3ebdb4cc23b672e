// Multiple scattering of the reference: its paths against its own quadrature where both are, against closed forms, and what they
// say of their own errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "common/formulas/double.h"
#include "common/reference/reference.h"
#include "tests/parity/inputs.h"
#include "tests/tolerances.h"
#include "tests/truth/scenes.h"

namespace airlight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Extent small{8, 6};
constexpr int all_orders = 1000000;

ReferenceSettings settings(int max_bounces, int paths, bool single_by_paths = false, std::uint32_t seed = 0) {
  ReferenceSettings s;
  s.tolerance = 1e-8;
  s.max_bounces = max_bounces, s.paths = paths, s.single_by_paths = single_by_paths, s.seed = seed;
  return s;
}

ReferenceFrame rendered(const Scene& scene, const ReferenceSettings& s, int threads = 2) {
  NoProgress progress;
  return reference_frame(scene, small, s, false, threads, progress);
}

// A lamp in the picture, one beside it, and the sun.
Scene lit(Scene scene) {
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.6};
  scene.medium.albedo = {0.9, 0.7, 0.5};
  scene.lights = {point_light({0.5, 0.3, -3.2}, {3, 5, 4}), point_light({-2.5, 1, -4}, {8, 6, 9}),
                  directional_light({0.3, -1, -0.4}, {0.3, 0.4, 0.5})};
  return scene;
}

Scene fog() { return lit(foggy_scene(0.4)); }

Scene gaussians() {
  Scene scene = lit({});
  scene.medium.gaussians = {{.center = {-0.4, 0.1, -3.5}, .radius = 0.9, .extinction = 1.5, .albedo = {0.9, 0.8, 1}},
                            {.center = {0.8, -0.3, -4.5}, .radius = 1.1, .extinction = 1, .albedo = {0.6, 0.9, 0.9}}};
  return scene;
}

Scene grid(double scale = 1.5) {
  Scene scene = lit({});
  const glm::ivec3 size(7, 6, 8);
  std::vector<float> values;
  for (std::uint32_t i = 0; i < 7 * 6 * 8; ++i) values.push_back(static_cast<float>(std::max(uniform(820, i) - 0.3, 0.0)));
  GridMedium& g = scene.medium.grid.emplace();
  g.voxels = std::make_shared<const VoxelGrid>(VoxelGrid{size, std::move(values)});
  const glm::dmat4 turned = glm::rotate(glm::translate(glm::dmat4(1), {0, 0, -4}), 0.7, glm::normalize(glm::dvec3(1, 2, -0.5)));
  g.transform = glm::translate(glm::scale(turned, glm::dvec3(0.5)), -0.5 * glm::dvec3(size));
  g.scale = scale, g.albedo = {0.9, 0.8, 0.7};
  return scene;
}

// All three, and a wall and a sill that throw shadows into them.
Scene everything() {
  Scene scene = grid(0.8);
  scene.medium.extinction = 0.1;
  scene.medium.gaussians = gaussians().medium.gaussians;
  Mesh wall, sill;
  add_parallelogram(wall, {-6, -4, -6}, {12, 0, 0}, {0, 8, 0});
  add_parallelogram(sill, {-1.2, 0.6, -4.6}, {2.2, 0, 0}, {0, 0.1, 1.5});
  scene.surfaces = {surface(std::move(wall), diffuse(0.4F, 0.5F, 0.6F), true),
                    surface(std::move(sill), diffuse(0.4F, 0.5F, 0.6F), true)};
  return scene;
}

// Of the green channel, whose pixels are independent of each other.
struct Spread {
  double chi = 0, worst = 0;  // sum of the squares of distances beside the standard error, and the largest of these
  int within_one = 0, pixels = 0;
};

Spread spread(const ReferenceFrame& estimate, const ReferenceFrame& truth) {
  Spread s;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const double error = estimate.pixels[i].standard_error.y;
    const double apart = estimate.pixels[i].airlight.y - truth.pixels[i].airlight.y;
    if (error == 0 && apart == 0) continue;
    const double z = apart / error;
    s.chi += z * z, s.worst = std::max(s.worst, std::fabs(z));
    s.within_one += std::fabs(z) < 1 ? 1 : 0, ++s.pixels;
  }
  return s;
}

// Chi-square of k degrees is k with deviation sqrt(2 k).
void expect_agree(const char* name, const Spread& s) {
  std::printf("%s: %d pixels, chi-square %.1f, worst %.2f standard errors, %d within one\n", name, s.pixels, s.chi, s.worst,
              s.within_one);
  const double k = s.pixels;
  EXPECT_GT(s.pixels, 30);
  EXPECT_FALSE(!(std::fabs(s.chi - k) <= 4 * std::sqrt(2 * k)));
  EXPECT_FALSE(!(s.worst <= 4));
  EXPECT_FALSE(!(std::fabs(s.within_one - 0.683 * k) <= 4 * std::sqrt(0.22 * k)));
}

struct Named {
  const char* name;
  Scene scene;
};

std::vector<Named> media() { return {{"fog", fog()}, {"Gaussians", gaussians()}, {"grid", grid()}, {"everything", everything()}}; }

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
  for (const Named& m : media()) {
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
    const ReferencePixel p = Reference(scene, settings(orders, 20000)).pixel(centre, one_pixel);
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

// What a lamp of 1 W/sr within two Gaussians that absorb nothing sends out is 4 pi W, scattered or not: lines from all sides.
void furnace(const Phase& phase) {
  Scene scene;
  scene.medium.phase = phase;
  scene.medium.gaussians = {{.center = {0.2, 0.1, 0}, .radius = 1, .extinction = 1.4},
                            {.center = {-0.4, -0.2, 0.3}, .radius = 0.8, .extinction = 1.2}};
  scene.lights = {point_light({0.1, 0.4, -0.2}, {1, 1, 1})};
  const auto on_sphere = [](double u, double v) {
    const double z = 2 * u - 1, s = std::sqrt(1 - z * z);
    return glm::dvec3(s * std::cos(2 * pi * v), s * std::sin(2 * pi * v), z);
  };
  double straight = 0;
  constexpr int directions = 2000;
  for (int i = 0; i < directions; ++i) {
    const glm::dvec3 d = on_sphere((i + 0.5) / directions, 0.5 * (std::sqrt(5.0) - 1) * i);
    straight += 4 * pi / directions * std::exp(-optical_depth(scene.medium.gaussians, scene.lights[0].position, d, 100));
  }
  // Lines: direction evenly on the sphere, place on the plane across it by a Gaussian of deviation `wide`.
  constexpr int lines = 12000;
  constexpr double wide = 1;
  double sum = 0, squares = 0;
  for (std::uint32_t i = 0; i < lines; ++i) {
    const glm::dvec3 d = on_sphere(uniform(830, 4 * i), uniform(830, 4 * i + 1));
    const glm::dvec3 a = glm::normalize(glm::cross(std::fabs(d.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), d));
    const double b = wide * std::sqrt(-2 * std::log(1 - uniform(830, 4 * i + 2))), angle = 2 * pi * uniform(830, 4 * i + 3);
    scene.camera.position = b * (std::cos(angle) * a + std::sin(angle) * glm::cross(d, a)) - 20.0 * d;
    scene.camera.look_at = scene.camera.position + d, scene.camera.up = a;
    const ReferencePixel p = Reference(scene, settings(all_orders, 2, true, i)).pixel(centre, one_pixel);
    const double density = std::exp(-b * b / (2 * wide * wide)) / (2 * pi * wide * wide);
    const double value = 4 * pi * p.airlight.y / density;
    sum += value, squares += value * value;
  }
  const double mean = sum / lines, error = std::sqrt((squares / lines - mean * mean) / lines);
  std::printf("g = %g: %.4f of the lamp's power leaves, %.4f of it unscattered; standard error %.4f\n", phase.g,
              (straight + mean) / (4 * pi), straight / (4 * pi), error / (4 * pi));
  EXPECT_LT(error, 0.015 * 4 * pi);
  EXPECT_FALSE(!(std::fabs(straight + mean - 4 * pi) <= 4 * error));
  EXPECT_GT(mean, 0.5 * 4 * pi);
}

TEST(Paths, WhatDoesNotAbsorbSendsOutWhatItGets) {
  furnace({});
  furnace({PhaseKind::henyey_greenstein, 0.7});
}

// Fog that absorbs nothing and never ends: by diffusion light of a lamp gets everywhere, and paths come to an end all the same.
// The fluence of an isotropic point source in such a medium is 1 / (4 pi D r) far away, D = 1 / (3 sigma): seen at a distance of r,
// the mean over directions of the radiance is 3 sigma / (4 pi)^2 / r [1/(4 pi) of the fluence, per W].
TEST(Paths, FogWithoutBoundsOrLoss) {
  Scene scene = foggy_scene(1);
  constexpr double r = 6;
  scene.lights = {point_light({0, 0, -r}, glm::dvec3(1 / (4 * pi)))};
  double mean = 0, variance = 0;
  constexpr int lines = 40;
  for (int i = 0; i < lines; ++i) {
    const double z = 2 * (i + 0.5) / lines - 1;
    scene.camera.look_at = {std::sqrt(1 - z * z), 0, z};
    const ReferencePixel p = Reference(scene, settings(all_orders, 60, false, static_cast<std::uint32_t>(i))).pixel(centre, one_pixel);
    mean += p.airlight.y / lines, variance += p.standard_error.y * p.standard_error.y / (lines * lines);
  }
  const double truth = 3 / (16 * pi * pi * r), error = std::sqrt(variance);
  std::printf("mean radiance %.5f, by diffusion %.5f, standard error %.5f\n", mean, truth, error);
  EXPECT_LT(error, 0.1 * truth);
  EXPECT_FALSE(!(std::fabs(mean - truth) <= 4 * error + 0.02 * truth));
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
    ReferenceSettings with = settings(4, 30);
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
  EXPECT_GT(sun, 0.01 * most);
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

TEST(Paths, SameBitsForAnyNumberOfThreads) {
  const Scene scene = everything();
  const ReferenceFrame one = rendered(scene, settings(5, 20), 1), three = rendered(scene, settings(5, 20), 3);
  const ReferenceFrame other = rendered(scene, settings(5, 20, false, 1), 3);
  int differ = 0;
  for (std::size_t i = 0; i < one.pixels.size(); ++i) {
    EXPECT_EQ(std::memcmp(&one.pixels[i].airlight, &three.pixels[i].airlight, sizeof(glm::dvec3)), 0);
    EXPECT_EQ(std::memcmp(&one.pixels[i].standard_error, &three.pixels[i].standard_error, sizeof(glm::dvec3)), 0);
    differ += one.pixels[i].airlight != other.pixels[i].airlight ? 1 : 0;
  }
  EXPECT_EQ(differ, 48);  // another seed gives other paths
}

// Four times the paths halve it, and many images that are known worse lie about a better one as their errors say.
TEST(Paths, StandardErrorIsTrue) {
  const Scene scene = everything();
  const auto mean_error = [](const ReferenceFrame& f) {
    double sum = 0;
    for (const ReferencePixel& p : f.pixels) sum += p.standard_error.y;
    return sum / static_cast<double>(f.pixels.size());
  };
  const ReferenceFrame best = rendered(scene, settings(4, 6400, false, 99));
  const double last = mean_error(best);
  for (const int paths : {100, 400, 1600}) {
    const double error = mean_error(rendered(scene, settings(4, paths)));
    const double ratio = error / last / std::sqrt(6400.0 / paths);
    std::printf("%d paths: standard error %.3g, %.3f of what 6400 paths let expect\n", paths, error, ratio);
    EXPECT_FALSE(!(std::fabs(ratio - 1) <= 0.15));
  }
  double chi = 0;
  int count = 0;
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    const ReferenceFrame f = rendered(scene, settings(4, 200, false, seed));
    for (std::size_t i = 0; i < f.pixels.size(); ++i, ++count) {
      const double apart = f.pixels[i].airlight.y - best.pixels[i].airlight.y;
      const double error = std::hypot(f.pixels[i].standard_error.y, best.pixels[i].standard_error.y);
      chi += apart * apart / (error * error);
    }
  }
  std::printf("chi-square of %d pixels of eight images: %.0f\n", count, chi);
  EXPECT_FALSE(!(std::fabs(chi - count) <= 5 * std::sqrt(2.0 * count)));
}

TEST(Paths, RefusesASumThatIsNone) {
  Scene scene = foggy_scene(0.1);
  scene.lights = {directional_light({0, -1, 0}, {1, 1, 1})};
  EXPECT_THROW(Reference(scene, settings(all_orders, 2)), InputError);
  EXPECT_NO_THROW(Reference(scene, settings(1000, 2)));
  scene.medium.albedo = glm::dvec3(0.999);
  EXPECT_NO_THROW(Reference(scene, settings(all_orders, 2)));
}

}  // namespace
}  // namespace airlight
