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

// A unit vector, and one across it.
struct Frame {
  glm::dvec3 d, across;

  Frame(double u, double v) {
    const double z = 2 * u - 1, s = std::sqrt(1 - z * z);
    d = {s * std::cos(2 * pi * v), s * std::sin(2 * pi * v), z};
    across = glm::normalize(glm::cross(std::fabs(d.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), d));
  }
  glm::dvec3 beside(double b, double angle) const {
    return b * (std::cos(angle) * across + std::sin(angle) * glm::cross(d, across));
  }
};

// What two Gaussians that absorb nothing take of the sun's light they send out, to all sides.
void in_and_out(const Phase& phase) {
  Scene scene;
  scene.medium.phase = phase;
  scene.medium.gaussians = {{.center = {0.2, 0.1, 0}, .radius = 1, .extinction = 1.4},
                            {.center = {-0.4, -0.2, 0.3}, .radius = 0.8, .extinction = 1.2}};
  scene.lights = {directional_light({0.3, -1, -0.4}, {1, 1, 1})};
  double in = 0;
  constexpr int rays = 160;
  constexpr double reach = 4;  // [m] where as good as nothing is left of them
  const glm::dvec3 sun = scene.lights[0].direction, a = glm::normalize(glm::cross(sun, {1, 0, 0})), b = glm::cross(sun, a);
  for (int i = 0; i < rays * rays; ++i) {
    const double step = 2 * reach / rays, x = (i % rays + 0.5) * step - reach, y = (i / rays + 0.5) * step - reach;
    in -= step * step * std::expm1(-optical_depth(scene.medium.gaussians, x * a + y * b - 20.0 * sun, sun, 40));
  }
  // Lines: direction evenly on the sphere, place on the plane across it by a Gaussian of deviation 1.
  constexpr int lines = 8000;
  double sum = 0, squares = 0;
  for (std::uint32_t i = 0; i < lines; ++i) {
    const Frame way(uniform(830, 4 * i), uniform(830, 4 * i + 1));
    const double distance = std::sqrt(-2 * std::log(1 - uniform(830, 4 * i + 2)));
    scene.camera.position = way.beside(distance, 2 * pi * uniform(830, 4 * i + 3)) - 20.0 * way.d;
    scene.camera.look_at = scene.camera.position + way.d, scene.camera.up = way.across;
    const ReferencePixel p = Reference(scene, settings(all_orders, 2, true, i)).pixel(centre, one_pixel);
    const double value = 4 * pi * p.airlight.y * 2 * pi * std::exp(0.5 * distance * distance);
    sum += value, squares += value * value;
  }
  const double mean = sum / lines, error = std::sqrt((squares / lines - mean * mean) / lines);
  std::printf("g = %g: %.4f of what is taken leaves, standard error %.4f\n", phase.g, mean / in, error / in);
  EXPECT_LT(error, 0.02 * in);
  EXPECT_FALSE(!(std::fabs(mean - in) <= 4 * error));
}

TEST(Paths, WhatDoesNotAbsorbSendsOutWhatItTakes) {
  in_and_out({});
  in_and_out({PhaseKind::henyey_greenstein, 0.7});
}

// Where the same radiance comes from everywhere and nothing is absorbed, it is all that is to be seen.
void in_a_furnace(const Phase& phase) {
  Scene scene;
  scene.camera = {.position = {0.3, 0.2, 5}, .look_at = {0, 0, 0}, .vertical_fov = 10};
  scene.medium.phase = phase;
  scene.medium.gaussians = {{.center = {0.2, 0.1, 0}, .radius = 1, .extinction = 1.4},
                            {.center = {-0.4, -0.2, 0.3}, .radius = 0.8, .extinction = 1.2}};
  scene.environment = Environment{.image = nullptr, .radiance = {1, 2, 0.5}};
  const ReferencePixel p = Reference(scene, settings(all_orders, 4000, true, 11)).pixel(centre, one_pixel);
  for (int c = 0; c < 3; ++c) {
    const double seen = p.beauty()[c], error = p.standard_error[c], truth = scene.environment->radiance[c];
    std::printf("g = %g: %.4f of %g, transmittance %.3f, standard error %.4f\n", phase.g, seen, truth, p.transmittance, error);
    EXPECT_LT(error, 0.02 * truth);
    EXPECT_FALSE(!(std::fabs(seen - truth) <= 4 * error));
  }
}

TEST(Paths, AFurnaceIsAllThatIsSeen) {
  in_a_furnace({});
  in_a_furnace({PhaseKind::henyey_greenstein, 0.7});
}

// Fluence [1/m^2] at a distance r of a lamp of 1 W in endless fog of 1/m that scatters evenly, what comes straight included (Case
// and Zweifel 1967, section 2.6): the mode of diffusion, whose wave number k is the root of c atanh(k) = k, and a transient,
// 1 / (4 pi r) (-dk^2/dc exp(-k r) + int_0^1 exp(-r / u) / u^2 / ((1 - c u atanh(u))^2 + (pi c u / 2)^2) du).
double fluence(double c, double r) {
  const auto square_of_wave_number = [](double albedo) {
    double low = 1e-9, high = 1 - 1e-15;
    for (int i = 0; i < 100; ++i) {
      const double k = 0.5 * (low + high);
      (albedo * std::atanh(k) < k ? low : high) = k;
    }
    return low * low;
  };
  const double step = 1e-4, k2 = c < 1 ? square_of_wave_number(c) : 0;
  const double slope = c < 1 ? (square_of_wave_number(c + step) - square_of_wave_number(c - step)) / (2 * step) : -3;
  double transient = 0;
  constexpr int nodes = 20000;
  for (int i = 0; i < nodes; ++i) {
    const double u = (i + 0.5) / nodes, one = 1 - c * u * std::atanh(u), other = pi * c * u / 2;
    transient += std::exp(-r / u) / (u * u * (one * one + other * other)) / nodes;
  }
  return (transient - slope * std::exp(-std::sqrt(k2) * r)) / (4 * pi * r);
}

// Also where nothing is absorbed: light of a lamp gets everywhere, and paths come to an end all the same.
TEST(Paths, LampInFogWithoutBounds) {
  EXPECT_NEAR(fluence(1e-9, 2), std::exp(-2.0) / (16 * pi), 1e-7);
  constexpr double r = 2;
  constexpr int lines = 24;
  for (const double albedo : {0.8, 1.0}) {
    Scene scene = foggy_scene(1);
    scene.medium.albedo = glm::dvec3(albedo);
    scene.lights = {point_light({0, 0, -r}, glm::dvec3(1 / (4 * pi)))};
    double mean = 0, variance = 0;
    for (std::uint32_t i = 0; i < lines; ++i) {
      const double angle = pi * (i + 0.5) / lines, share = 0.5 * std::sin(angle) * pi / lines;
      scene.camera.look_at = {std::sin(angle), 0, -std::cos(angle)};
      const int paths = albedo < 1 ? 1000 : 120;
      const ReferencePixel p = Reference(scene, settings(all_orders, paths, false, i)).pixel(centre, one_pixel);
      mean += share * p.airlight.y, variance += std::pow(share * p.standard_error.y, 2);
    }
    const double truth = (fluence(albedo, r) - std::exp(-r) / (4 * pi * r * r)) / (4 * pi), error = std::sqrt(variance);
    std::printf("albedo %g: mean radiance %.6f, %.6f in closed form, standard error %.6f\n", albedo, mean, truth, error);
    EXPECT_LT(error, (albedo < 1 ? 0.06 : 0.3) * truth);
    EXPECT_FALSE(!(std::fabs(mean - truth) <= 4 * error));
  }
}

}  // namespace
}  // namespace airlight
