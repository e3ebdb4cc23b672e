// Voxel grids in the reference: against closed forms, against dense sums that share no code with it, beside other media.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "common/formulas/double.h"
#include "common/reference/reference.h"
#include "tests/tolerances.h"
#include "tests/truth/scenes.h"

namespace airlight {
namespace {

constexpr double pi = std::numbers::pi;

GridMedium grid_medium(const glm::ivec3& size, std::vector<float> values) {
  GridMedium grid;
  grid.voxels = std::make_shared<const VoxelGrid>(VoxelGrid{size, std::move(values)});
  return grid;
}

// Random values, a third of them 0, in cells of unequal sides, turned and moved.
GridMedium random_grid(const glm::ivec3& size, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> values;
  for (int i = 0; i < size.x * size.y * size.z; ++i) {
    const auto r = static_cast<float>(random() % 1024U) / 1024;
    values.push_back(r < 0.33F ? 0 : r);
  }
  GridMedium grid = grid_medium(size, std::move(values));
  glm::dmat4 m = glm::translate(glm::dmat4(1), {0.3, -0.2, -4});
  m = glm::rotate(m, 0.7, glm::normalize(glm::dvec3(1, 2, -0.5)));
  m = glm::scale(m, {0.5, 0.3, 0.4});
  grid.transform = glm::translate(m, -0.5 * glm::dvec3(size));
  grid.scale = 1.7;
  grid.albedo = {0.9, 0.7, 0.5};
  return grid;
}

// 0.5 /m in a box of 20 x 24 x 40 m around the origin.
GridMedium constant_grid() {
  const glm::ivec3 size(10, 12, 20);
  GridMedium grid = grid_medium(size, std::vector<float>(2400, 0.25F));
  grid.transform = glm::translate(glm::scale(glm::dmat4(1), glm::dvec3(2)), -0.5 * glm::dvec3(size));
  grid.scale = 2;
  grid.albedo = {0.9, 0.8, 0.7};
  return grid;
}

// Infinite for NaN, which a maximum would lose.
double relative(double value, double truth) {
  const double error = std::fabs(value - truth) / std::fabs(truth);
  return error >= 0 ? error : std::numeric_limits<double>::infinity();
}

// Camera, lamp and the end of the ray stand where it is constant.
TEST(Grid, ConstantEqualsHomogeneous) {
  Scene fog = foggy_scene(0.5);
  fog.medium.phase = {PhaseKind::henyey_greenstein, 0.4};
  fog.medium.albedo = {0.9, 0.8, 0.7};
  fog.medium.ambient = {0.1, 0.2, 0.3};
  fog.sky_distance = 7;
  fog.background = {1, 2, 3};
  fog.lights = {point_light({1.5, 0.8, -3}, {10, 20, 30})};
  Mesh wall;
  add_parallelogram(wall, {-2, -2, -6}, {2, 0, 0}, {0, 4, 0.5});
  fog.surfaces = {surface(std::move(wall), diffuse(0.5F, 0.6F, 0.7F), false)};
  Scene grid = fog;
  grid.medium.extinction = 0;
  grid.medium.grid = constant_grid();
  const Reference homogeneous(fog, {1e-11, true}), voxels(grid, {1e-11, true});
  double worst = 0;
  for (int i = 0; i < 64; ++i) {
    const glm::dvec2 at(0.5 + i % 8, 0.5 + i / 8);
    const ReferencePixel a = homogeneous.pixel(at, {8, 8}), b = voxels.pixel(at, {8, 8});
    worst = std::max(worst, relative(b.optical_depth, a.optical_depth));
    for (int c = 0; c < 3; ++c)
      worst = std::max({worst, relative(b.airlight[c], a.airlight[c]), relative(b.surface[c], a.surface[c])});
  }
  std::printf("64 pixels, largest relative difference %.2g\n", worst);
  EXPECT_FALSE(!(worst <= tolerance("grid_closed_form")));
}

// A directional light from above reaches a level ray through the same depth everywhere.
TEST(Grid, ConstantUnderSun) {
  Scene scene;
  scene.medium.grid = constant_grid();
  scene.sky_distance = 8;
  scene.lights = {directional_light({0, -1, 0}, {1, 2, 3})};
  const ReferencePixel p = Reference(scene, {1e-11, true}).pixel(centre, one_pixel);
  double worst = relative(p.optical_depth, 0.5 * 8);
  for (int c = 0; c < 3; ++c) {
    const double truth = (c + 1) * scene.medium.grid->albedo[c] / (4 * pi) * std::exp(-0.5 * 12) * -std::expm1(-0.5 * 8);
    worst = std::max(worst, relative(p.airlight[c], truth));
  }
  // Through the whole box, whose ramps half a cell wide on either side of its faces count as half a cell each.
  scene.camera = {.position = {0, 0, 100}, .look_at = {0, 0, 0}};
  scene.sky_distance = std::numeric_limits<double>::infinity();
  worst = std::max(worst, relative(Reference(scene).pixel(centre, one_pixel).optical_depth, 0.5 * 40));
  std::printf("largest relative difference %.2g\n", worst);
  EXPECT_FALSE(!(worst <= tolerance("grid_closed_form")));
}

// What the formulas say of a point, in cells: the definition that kernels compile too.
double value_of_formulas(const VoxelGrid& v, const glm::dvec3& cell) {
  double lower[3], weight[3];
  for (int k = 0; k < 3; ++k) {
    const double n = v.size[k];
    f64::grid_lookup_zero(f64::grid_coordinate(cell[k], n, n), n, lower[k], weight[k]);
  }
  double sum = 0;
  for (int i = 0; i < 8; ++i) {
    double w = 1;
    glm::ivec3 at;
    for (int k = 0; k < 3; ++k) {
      const int side = i >> k & 1;
      at[k] = static_cast<int>(lower[k]) + side;
      w *= side == 1 ? weight[k] : 1 - weight[k];
    }
    if (at.x < 0 || at.y < 0 || at.z < 0 || at.x >= v.size.x || at.y >= v.size.y || at.z >= v.size.z) continue;
    sum += w * static_cast<double>(v.values[static_cast<std::size_t>(at.x + v.size.x * (at.y + v.size.y * at.z))]);
  }
  return sum;
}

// Lines through, beside, along and from within a grid of several blocks, with empty ones.
TEST(Grid, OpticalDepthAgainstFormulas) {
  GridMedium grid = random_grid({23, 9, 31}, 3);
  VoxelGrid holes = *grid.voxels;
  for (int z = 4; z < 27; ++z) {
    for (int y = 0; y < 9; ++y) std::fill_n(holes.values.begin() + (23 * (y + 9 * z)), 23 - (z % 3), 0.0F);
  }
  grid.voxels = std::make_shared<const VoxelGrid>(holes);
  const GridField field(grid);
  const glm::dmat4 to_cells = glm::inverse(grid.transform);
  std::mt19937 random(5);
  const auto number = [&] { return static_cast<double>(random()) / 0x1p32; };
  const auto in_world = [&](const glm::dvec3& cell) { return glm::dvec3(grid.transform * glm::dvec4(cell, 1)); };
  constexpr int steps = 400000;
  double worst = 0, least = 1e9, most = 0;
  for (int i = 0; i < 40; ++i) {
    // From a point in or around the grid; one in four along an axis of it, on a plane of centres.
    glm::dvec3 a, b;
    for (int k = 0; k < 3; ++k) {
      a[k] = (1.6 * number() - 0.3) * grid.voxels->size[k], b[k] = (1.6 * number() - 0.3) * grid.voxels->size[k];
      if (i % 4 == 0 && k != i / 4 % 3) a[k] = b[k] = std::floor(number() * grid.voxels->size[k]) + 0.5;
    }
    const glm::dvec3 from = in_world(a), way = in_world(b) - from;
    const double length = glm::length(way);
    const double value = field.depth(from, way / length, length);
    double sum = 0;
    for (int s = 0; s < steps; ++s) {
      const glm::dvec3 x = from + (s + 0.5) / steps * way;
      sum += value_of_formulas(*grid.voxels, glm::dvec3(to_cells * glm::dvec4(x, 1)));
    }
    sum *= grid.scale * length / steps;
    const GridOnLine on_line(field, from, way / length, length);
    EXPECT_EQ(on_line.depth(length), value);
    EXPECT_TRUE(std::isfinite(value));
    worst = std::max(worst, std::fabs(value - sum));
    least = std::min(least, sum), most = std::max(most, sum);
  }
  std::printf("40 lines of optical depth %.3g..%.3g, largest difference %.2g\n", least, most, worst);
  EXPECT_FALSE(!(worst <= tolerance("grid_depth")));
  EXPECT_GT(most, 1);
}

// depth() and extinction() along a ray against each other: one is the integral of the other.
TEST(Grid, DepthOnLineGrowsByExtinction) {
  const GridField field(random_grid({7, 6, 5}, 9));
  const GridOnLine line(field, {0.1, 0.2, 0}, glm::normalize(glm::dvec3(0.05, -0.1, -1)), 100);
  ASSERT_FALSE(line.empty());
  EXPECT_EQ(line.depth(line.begin()), 0);
  EXPECT_EQ(line.depth(line.end()), line.depth(1e300));
  EXPECT_EQ(line.extinction(line.begin() - 1e-9), 0);
  EXPECT_EQ(line.extinction(line.end() + 1e-9), 0);
  constexpr int steps = 200000;
  const double step = (line.end() - line.begin()) / steps;
  double sum = 0, worst = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = line.begin() + i * step;
    worst = std::max(worst, std::fabs(line.depth(t) - sum));
    sum += step * line.extinction(t + 0.5 * step);
  }
  std::printf("optical depth %.3g, largest difference %.2g\n", sum, worst);
  EXPECT_FALSE(!(worst <= tolerance("grid_depth")));
}

// A plain sum over the ray, and at each of its steps one over the way to the light. It shares no code with the reference, nor
// with the formulas: a value is the sum over all cells of tents around their centres.
struct BruteForce {
  Scene scene;
  glm::dmat4 to_cells;

  explicit BruteForce(const Scene& s) : scene(s), to_cells(glm::inverse(s.medium.grid->transform)) {}

  double grid(const glm::dvec3& x) const {
    const GridMedium& g = *scene.medium.grid;
    const glm::ivec3 n = g.voxels->size;
    const glm::dvec3 p = glm::dvec3(to_cells * glm::dvec4(x, 1)) - 0.5;
    if (p.x <= -1 || p.y <= -1 || p.z <= -1 || p.x >= n.x || p.y >= n.y || p.z >= n.z) return 0;
    double sum = 0;
    std::size_t at = 0;
    for (int k = 0; k < n.z; ++k) {
      const double w = std::max(0.0, 1 - std::fabs(p.z - k));
      for (int j = 0; j < n.y; ++j) {
        const double v = w * std::max(0.0, 1 - std::fabs(p.y - j));
        for (int i = 0; i < n.x; ++i, ++at)
          sum += v * std::max(0.0, 1 - std::fabs(p.x - i)) * static_cast<double>(g.voxels->values[at]);
      }
    }
    return g.scale * sum;
  }
  double gaussian(const Gaussian& g, const glm::dvec3& x) const {
    const glm::dvec3 p = (x - g.center) / g.radius;
    return g.extinction * std::exp(-glm::dot(p, p));
  }
  // `sun`: the homogeneous part does not count.
  double extinction(const glm::dvec3& x, bool sun) const {
    double sum = grid(x) + (sun ? 0 : scene.medium.extinction);
    for (const Gaussian& g : scene.medium.gaussians) sum += gaussian(g, x);
    return sum;
  }
  double depth(const glm::dvec3& a, const glm::dvec3& b, bool sun, int steps) const {
    double sum = 0;
    for (int i = 0; i < steps; ++i) sum += extinction(a + (i + 0.5) / steps * (b - a), sun);
    return sum * glm::length(b - a) / steps;
  }

  glm::dvec3 airlight(const glm::dvec3& d, double length, int steps, int light_steps) const {
    glm::dvec3 sum(0);
    double depth_here = 0;
    const double step = length / steps, g = scene.medium.phase.g;
    for (int i = 0; i < steps; ++i) {
      const glm::dvec3 x = scene.camera.position + (i + 0.5) * step * d;
      const double in_grid = grid(x), all = extinction(x, false);
      glm::dvec3 scattering = scene.medium.extinction * scene.medium.albedo + in_grid * scene.medium.grid->albedo;
      for (const Gaussian& one : scene.medium.gaussians) scattering += gaussian(one, x) * one.albedo;
      const double seen = std::exp(-(depth_here + 0.5 * all * step));
      depth_here += all * step;
      sum += seen * step * all * scene.medium.ambient;
      for (const LightSource& light : scene.lights) {
        const bool sun = light.type == LightType::directional;
        const glm::dvec3 way = sun ? -12.0 * light.direction : light.position - x;  // 12 m leave everything behind
        const double mu = glm::dot(-glm::normalize(way), -d);
        const double phase = (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * mu, 1.5));
        const double arriving = std::exp(-depth(x, x + way, sun, light_steps)) / (sun ? 1 : glm::dot(way, way));
        sum += seen * step * phase * arriving * scattering * light.power;
      }
    }
    return sum;
  }
};

TEST(Grid, AirlightAgainstPlainSums) {
  Scene scene;
  scene.camera = {.position = {0.1, 0.2, 0.5}, .look_at = {0.2, -0.1, -4}, .vertical_fov = 30};
  scene.sky_distance = 9;
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.35};
  scene.medium.albedo = {0.8, 0.9, 1};
  scene.medium.ambient = {0.01, 0.02, 0.03};
  scene.medium.extinction = 0.05;
  scene.medium.gaussians = {{.center = {0.5, 0.4, -3.4}, .radius = 0.7, .extinction = 0.6, .albedo = {1, 0.8, 0.6}}};
  scene.medium.grid = random_grid({5, 4, 6}, 21);
  scene.lights = {point_light({-1.9, 1.6, -3.2}, {10, 9, 8}), directional_light({0.4, -1, -0.3}, {0.5, 0.6, 0.9})};
  const BruteForce brute_force(scene);
  const Reference reference(scene, {1e-9, true});
  const double tan = std::tan(15 * pi / 180);
  const glm::dvec3 forward = glm::normalize(scene.camera.look_at - scene.camera.position);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0))), up = glm::cross(right, forward);
  double worst = 0;
  for (const glm::dvec2 at : {glm::dvec2(4.5, 4.5), {2.5, 5.5}, {6.5, 3.5}, {0.5, 0.5}}) {
    const glm::dvec3 d = glm::normalize(forward + (at.x / 4.5 - 1) * tan * right + (1 - at.y / 4.5) * tan * up);
    const ReferencePixel pixel = reference.pixel(at, {9, 9});
    const glm::dvec3 sum = brute_force.airlight(d, 9, 1500, 600);
    const double depth = brute_force.depth(scene.camera.position, scene.camera.position + 9.0 * d, false, 20000);
    double error = relative(pixel.optical_depth, depth);
    for (int c = 0; c < 3; ++c) error = std::max(error, relative(pixel.airlight[c], sum[c]));
    std::printf("pixel %.1f %.1f: optical depth %.3f, airlight %.5f, relative error %.2g (claimed %.2g)\n", at.x, at.y, depth,
                pixel.airlight.x, error, pixel.error);
    worst = std::max(worst, error);
  }
  EXPECT_FALSE(!(worst <= tolerance("grid_riemann_sum")));
}

// Media add up: optical depths do, and transmittances multiply.
TEST(Grid, AddsToOtherMedia) {
  Scene all = foggy_scene(0.07);
  all.sky_distance = 10;
  all.medium.gaussians = {{.center = {0.2, 0.1, -4}, .radius = 0.8, .extinction = 0.9}};
  all.medium.grid = random_grid({6, 7, 5}, 2);
  Scene fog = all, gaussians = all, grid = all;
  fog.medium.gaussians.clear(), fog.medium.grid.reset();
  gaussians.medium.extinction = 0, gaussians.medium.grid.reset();
  grid.medium.extinction = 0, grid.medium.gaussians.clear();
  double worst = 0, most = 0;
  for (int i = 0; i < 49; ++i) {
    const auto of = [&](const Scene& s) {
      return Reference(s).pixel({0.5 + i % 7, 0.5 + i / 7}, {7, 7}, {false, false}).optical_depth;
    };
    most = std::max(most, of(grid));
    worst = std::max(worst, relative(of(all), of(fog) + of(gaussians) + of(grid)));
  }
  std::printf("49 rays, largest relative difference %.2g, largest optical depth of the grid %.3g\n", worst, most);
  EXPECT_FALSE(!(worst <= tolerance("exact_double")));
  EXPECT_GT(most, 0.5);
}

// A tighter tolerance stays within what a looser one claims, also where only the light's way passes the grid.
TEST(Grid, ErrorIsWithinTheClaim) {
  Scene scene = foggy_scene(0.1);
  scene.camera = {.position = {0, 0, 3}, .look_at = {0, 0, -4}, .vertical_fov = 60};
  scene.sky_distance = 15;
  scene.medium.grid = random_grid({9, 8, 7}, 4);
  scene.lights = {point_light({0.4, 0.3, -3.8}, {3, 2, 1}), point_light({-3, 2, -4}, {30, 40, 50}),
                  directional_light({1, -1, -0.5}, {1, 1, 1})};
  const Reference loose(scene, {1e-5, true}), tight(scene, {1e-9, true});
  double worst = 0, claimed = 0;
  int beyond = 0;
  for (int i = 0; i < 100; ++i) {
    const glm::dvec2 at(0.5 + i % 10, 0.5 + i / 10);
    const ReferencePixel a = loose.pixel(at, {10, 10}), b = tight.pixel(at, {10, 10});
    double error = 0;
    for (int c = 0; c < 3; ++c) error = std::max(error, relative(a.airlight[c], b.airlight[c]));
    beyond += error > a.error + b.error;
    worst = std::max(worst, error), claimed = std::max(claimed, a.error);
  }
  std::printf("100 pixels, largest relative error %.2g, largest claimed %.2g, %d beyond their claim\n", worst, claimed, beyond);
  EXPECT_FALSE(!(worst <= 1e-5));
  EXPECT_EQ(beyond, 0);
}

}  // namespace
}  // namespace airlight
