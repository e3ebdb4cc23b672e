// Multiple scattering of the reference where nothing is absorbed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/truth/path_scenes.h"

namespace airlight {

using namespace path_test;

namespace {

constexpr double pi = std::numbers::pi;

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
// The fluence of an isotropic point source in such a medium is 1 / (4 pi D r) far away, D = 1 / (3 sigma): seen at a distance of
// r, the mean over directions of the radiance is 3 sigma / (4 pi)^2 / r [1/(4 pi) of the fluence, per W].
TEST(Paths, FogWithoutBoundsOrLoss) {
  Scene scene = foggy_scene(1);
  constexpr double r = 6;
  scene.lights = {point_light({0, 0, -r}, glm::dvec3(1 / (4 * pi)))};
  double mean = 0, variance = 0;
  constexpr int lines = 40;
  for (int i = 0; i < lines; ++i) {
    const double z = 2 * (i + 0.5) / lines - 1;
    scene.camera.look_at = {std::sqrt(1 - z * z), 0, z};
    const ReferencePixel p =
        Reference(scene, settings(all_orders, 60, false, static_cast<std::uint32_t>(i))).pixel(centre, one_pixel);
    mean += p.airlight.y / lines, variance += p.standard_error.y * p.standard_error.y / (lines * lines);
  }
  const double truth = 3 / (16 * pi * pi * r), error = std::sqrt(variance);
  std::printf("mean radiance %.5f, by diffusion %.5f, standard error %.5f\n", mean, truth, error);
  EXPECT_LT(error, 0.1 * truth);
  EXPECT_FALSE(!(std::fabs(mean - truth) <= 4 * error + 0.02 * truth));
}

}  // namespace
}  // namespace airlight
