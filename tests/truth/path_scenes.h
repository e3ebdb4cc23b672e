// Scenes and measures of the tests of the reference's multiple scattering.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "common/reference/reference.h"
#include "tests/parity/inputs.h"
#include "tests/truth/scenes.h"

namespace airlight {

namespace path_test {

inline constexpr Extent small{8, 6};
inline constexpr int all_orders = 1000000;

inline ReferenceSettings settings(int max_bounces, int paths, bool single_by_paths = false, std::uint32_t seed = 0) {
  ReferenceSettings s;
  s.tolerance = 1e-8;
  s.max_bounces = max_bounces, s.paths = paths, s.single_by_paths = single_by_paths, s.seed = seed;
  return s;
}

inline ReferenceFrame rendered(const Scene& scene, const ReferenceSettings& s, int threads = 2) {
  NoProgress progress;
  return reference_frame(scene, small, s, false, threads, progress);
}

// A lamp in the picture, one beside it, and the sun.
inline Scene lit(Scene scene) {
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.6};
  scene.medium.albedo = {0.9, 0.7, 0.5};
  scene.lights = {point_light({0.5, 0.3, -3.2}, {3, 5, 4}), point_light({-2.5, 1, -4}, {8, 6, 9}),
                  directional_light({0.3, -1, -0.4}, {0.3, 0.4, 0.5})};
  return scene;
}

inline Scene fog() { return lit(foggy_scene(0.4)); }

inline Scene gaussians() {
  Scene scene = lit({});
  scene.medium.gaussians = {{.center = {-0.4, 0.1, -3.5}, .radius = 0.9, .extinction = 1.5, .albedo = {0.9, 0.8, 1}},
                            {.center = {0.8, -0.3, -4.5}, .radius = 1.1, .extinction = 1, .albedo = {0.6, 0.9, 0.9}}};
  return scene;
}

inline Scene grid(double scale = 1.5) {
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
inline Scene everything() {
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

inline Spread spread(const ReferenceFrame& estimate, const ReferenceFrame& truth) {
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
inline void expect_agree(const char* name, const Spread& s) {
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

inline std::vector<Named> media() {
  return {{"fog", fog()}, {"Gaussians", gaussians()}, {"grid", grid()}, {"everything", everything()}};
}

}  // namespace path_test

}  // namespace airlight
