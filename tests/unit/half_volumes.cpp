// Volumes kept in 16 bits: how numbers are rounded, on both backends, and what is left of the picture.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "app/airlight.h"
#include "common/algorithms/voxel_table.h"
#include "common/plan/depth_volumes.h"
#include "common/plan/geometry.h"
#include "common/plan/voxels.h"
#include "cpu/backend.h"
#include "gpu/backend.h"
#include "tests/parity/medium.h"
#include "tests/tolerances.h"

namespace airlight {
namespace {

constexpr std::uint16_t largest = 0x7bff;

float value_of(int half) {
  const int exponent = half >> 10, mantissa = half & 0x3ff;
  return exponent == 0 ? std::ldexp(static_cast<float>(mantissa), -24)
                       : std::ldexp(static_cast<float>(1024 + mantissa), exponent - 25);
}

TEST(HalfVolumes, NumbersAreRoundedToTheNearest) {
  for (int half = 0; half < largest; ++half) {
    ASSERT_EQ(float_of(static_cast<std::uint16_t>(half)), value_of(half)) << half;
    ASSERT_EQ(half_of(value_of(half)), half);
    const float middle = (value_of(half) + value_of(half + 1)) / 2;
    ASSERT_EQ(half_of(middle), half % 2 == 0 ? half : half + 1) << half;
    ASSERT_EQ(half_of(std::nextafter(middle, 0.0F)), half);
    ASSERT_EQ(half_of(std::nextafter(middle, 1e9F)), half + 1);
  }
  for (const float x : {65504.0F, 65520.0F, 1e6F, 3e38F, HUGE_VALF}) EXPECT_EQ(half_of(x), largest) << x;
}

// Of a grid the same numbers come out of the backends' own arithmetic to a few units in the last place of a float, so that few
// are rounded to another half, and none farther than the next but where numbers are small beside those they are differences of.
TEST(HalfVolumes, BackendsRoundAlike) {
  Scene scene;
  scene.medium.grid = test_grid();
  const MediumBox box = medium_box(scene, 40);
  Case c;
  DensityInjection injection;
  injection.voxels = add_voxels(c, *scene.medium.grid, 3);
  injection.grid = grid_density(*scene.medium.grid, box.corner);
  injection.size = box.cells;
  injection.cell = static_cast<float>(box.cell);
  injection.half_unit = 4;
  injection.extinction = {{1}, sizeof(float) * voxel_table_floats(box.cells, true)};
  OpticalDepthPropagation propagation;
  propagation.voxels = injection.extinction;
  propagation.grid = box_density(box, glm::vec3(1), box.corner);
  propagation.grid.half_unit = injection.half_unit;
  LightSource lamp;
  lamp.position = box.corner + box.size() * 0.4;
  propagation.light = light_of(lamp, box.corner);
  propagation.volume = depth_volume(box, lamp, box.corner);
  propagation.volume.halves = true;
  propagation.depths = {{2}, sizeof(float) * propagation.volume.floats()};
  const auto cpu = std::make_unique<CpuBackend>(CpuOptions{});
  const std::unique_ptr<Backend> gl = make_gl_backend({});
  Stats stats;
  NoProgress progress;
  for (Backend* backend : {static_cast<Backend*>(cpu.get()), gl.get()}) {
    upload(*backend, c);
    backend->run(std::vector<Step>{{injection, ""}, {propagation, ""}}, stats, progress);
  }
  struct Table {
    const char* name;
    Buffer buffer;
    std::size_t head, count;
  };
  for (const Table& table : {Table{"extinction", injection.extinction, 3, voxel_values(box.cells)},
                             Table{"depths", propagation.depths, DepthVolume::head, propagation.volume.depths()}}) {
    std::vector<std::byte> of[2];
    Backend* backends[2] = {cpu.get(), gl.get()};
    for (int b = 0; b < 2; ++b) {
      of[b].resize(table.buffer.bytes);
      backends[b]->download(table.buffer, of[b]);
    }
    EXPECT_EQ(std::memcmp(of[0].data(), of[1].data(), sizeof(float) * table.head), 0) << table.name;
    const auto half = [&](int b, std::size_t i) {
      std::uint16_t h = 0;
      std::memcpy(&h, of[b].data() + sizeof(float) * table.head + sizeof(h) * i, sizeof(h));
      return static_cast<int>(h);
    };
    std::size_t others = 0, met = 0;
    int most = 0;
    float apart = 0;
    for (std::size_t i = 0; i < table.count; ++i) {
      const int away = std::abs(half(0, i) - half(1, i));
      others += away != 0 ? 1 : 0;
      met += half(0, i) > 0 ? 1 : 0;
      most = std::max(most, half(0, i));
      if (away > 1) apart = std::max(apart, std::fabs(value_of(half(0, i)) - value_of(half(1, i))));
    }
    const double share = static_cast<double>(others) / static_cast<double>(met);
    std::printf("%s: %zu of %zu are not 0, %.4f %% of them another half; farther than the next: %.2g of the largest\n",
                table.name, met, table.count, 100 * share, static_cast<double>(apart / value_of(most)));
    EXPECT_GT(met, table.count / 10) << table.name;
    EXPECT_FALSE(!(static_cast<double>(apart / value_of(most)) < tolerance("half_beside_largest"))) << table.name;
    EXPECT_FALSE(!(share < tolerance("half_rounded_otherwise"))) << table.name;
  }
}

Scene blobs(double extinction, double size) {
  Scene scene;
  scene.camera.position = size * glm::dvec3(0.2, 0.5, 5);
  scene.camera.look_at = {0, 0, 0};
  scene.camera.resolution = {64, 48};
  scene.sky_distance = 30 * size;
  for (int i = 0; i < 6; ++i) {
    const glm::dvec3 center = size * glm::dvec3(0.4 * i - 1, 0.1 * i, -0.2 * i);
    scene.medium.gaussians.push_back({.center = center, .radius = 0.5 * size, .extinction = extinction / size});
  }
  LightSource lamp;
  lamp.position = size * glm::dvec3(1, 1.5, 1);
  lamp.power = {10, 8, 6};
  scene.lights = {lamp, lamp};
  scene.lights[1].type = LightType::directional;
  scene.lights[1].direction = glm::normalize(glm::dvec3(0.3, -1, 0.2));
  return scene;
}

struct Picture {
  HostImage image;
  std::uint64_t items = 0;  // [float] of the volumes
};

Picture render(const Scene& scene, const char* backend, const char* storage) {
  Renderer renderer({.backend = backend});
  RenderSettings settings;
  settings.technique = "opacity-propagation";
  settings.knobs = {{"resolution", "32"}, {"steps", "24"}, {"density", "volume"}, {"storage", storage}};
  const Frame frame = renderer.render(scene, settings);
  Picture picture{frame.image("beauty")};
  for (const StepStats& step : frame.stats.steps) {
    if (step.name == "density_injection" || step.name == "optical_depth_propagation") picture.items += step.items;
  }
  return picture;
}

// Thin, thick and opaque media, of every size: numbers do not end below and above.
TEST(HalfVolumes, LookLikeFloats) {
  for (const char* backend : {"cpu", "gl"}) {
    for (const double size : {1e-4, 1.0, 1e4}) {
      for (const double extinction : {1e-5, 0.8, 40.0, 1e6}) {
        const Scene scene = blobs(extinction, size);
        const Picture whole = render(scene, backend, "float"), half = render(scene, backend, "half");
        double error = 0, all = 0;
        for (std::size_t i = 0; i < whole.image.values.size(); ++i) {
          const double a = static_cast<double>(whole.image.values[i]), b = static_cast<double>(half.image.values[i]);
          ASSERT_TRUE(std::isfinite(b));
          error += (a - b) * (a - b);
          all += a * a;
        }
        const double relative = std::sqrt(error / all);
        std::printf("%s, optical depth %g in %g m: relative RMSE %.5f %% beside floats, %.3f of the memory\n", backend,
                    extinction, size, 100 * relative, static_cast<double>(half.items) / static_cast<double>(whole.items));
        EXPECT_GT(all, 0);
        EXPECT_FALSE(!(relative < tolerance("half_volumes"))) << extinction << ' ' << size;
        EXPECT_LT(static_cast<double>(half.items), 0.52 * static_cast<double>(whole.items));
      }
    }
  }
}

TEST(HalfVolumes, AreAlongTheLightsRays) {
  Renderer renderer({.backend = "cpu"});
  RenderSettings settings;
  settings.technique = "opacity-propagation";
  settings.knobs = {{"storage", "half"}, {"scheme", "upwind"}};
  EXPECT_THROW(renderer.render(blobs(1, 1), settings), InputError);
}

}  // namespace
}  // namespace airlight
