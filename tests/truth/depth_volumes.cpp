// Optical depths from volumes toward a light against closed forms: where lights stand to the medium, how fine the volume is, and
// by which scheme.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "common/algorithms/voxel_table.h"
#include "common/formulas/float.h"
#include "common/plan/depth_volumes.h"
#include "common/plan/geometry.h"
#include "common/reference/optical_depth.h"
#include "cpu/backend.h"
#include "tests/parity/inputs.h"
#include "tests/tolerances.h"
#include "tests/truth/optical_depth_table.h"

namespace airlight {
namespace {

// In a box of edge 1, the radii at least three cells of 32 an edge.
Scene blobs(int count) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    const auto number = [&](std::uint32_t which, double from, double to) {
      return from + (to - from) * uniform(611, 8 * static_cast<std::uint32_t>(i) + which);
    };
    const double radius = count == 1 ? 0.14 : number(0, 0.1, 0.13);
    const auto place = [&](std::uint32_t which) { return count == 1 ? 0.5 : number(which, 0.4, 0.6); };
    scene.medium.gaussians.push_back({.center = {place(1), place(2), place(3)},
                                      .radius = radius,
                                      .extinction = (count == 1 ? 1 : number(4, 0.05, 0.5)) / radius});
  }
  return scene;
}

LightSource light_at(const glm::dvec3& position) {
  LightSource light;
  light.position = position;
  return light;
}

struct Volume {
  DepthVolume shape;
  std::vector<float> table;

  float at(const glm::dvec3& p) const {
    f32::Float q[3];
    for (int i = 0; i < 3; ++i) {
      const glm::dvec4 row(shape.rows[i]);
      q[i] = f32::Float(glm::dot(glm::dvec3(row), p) + row.w);
    }
    return f32::depth_in_volume(table.data(), static_cast<int>(shape.kind), shape.halves ? 1 : 0, q[0], q[1], q[2]).v;
  }
};

enum class Scheme { rays, rays_through_volume, upwind, published };

Volume propagate(const Scene& scene, const MediumBox& box, const LightSource& light, Scheme scheme, bool halves) {
  const bool cells = scheme == Scheme::upwind || scheme == Scheme::published;
  std::vector<Step> steps;
  OpticalDepthPropagation p;
  p.gaussians = gaussians_of(scene, box.corner);
  if (scheme != Scheme::rays) {
    DensityInjection injection;
    injection.gaussians = p.gaussians;
    injection.size = box.cells;
    injection.cell = static_cast<float>(box.cell);
    injection.half_unit = halves ? static_cast<float>(std::exp2(-std::round(std::log2(box.cell)))) : 0;
    injection.extinction = {{1}, sizeof(float) * voxel_table_floats(box.cells, halves)};
    p.gaussians.clear();
    p.voxels = injection.extinction;
    p.grid = box_density(box, glm::vec3(1), box.corner);
    p.grid.half_unit = injection.half_unit;
    p.samples = 2;
    steps.push_back({injection, ""});
  }
  p.light = light_of(light, box.corner);
  p.volume = cells ? cell_volume(box, box.corner) : depth_volume(box, light, box.corner);
  p.volume.halves = halves;
  p.scheme = scheme == Scheme::published ? DepthScheme::published : DepthScheme::upwind;
  p.depths = {{2}, sizeof(float) * p.volume.floats()};
  steps.push_back({p, ""});
  CpuBackend backend({});
  Stats stats;
  NoProgress progress;
  backend.run(steps, stats, progress);
  Volume volume{p.volume, std::vector<float>(p.volume.floats())};
  backend.download(p.depths, std::as_writable_bytes(std::span(volume.table)));
  return volume;
}

// Root mean square over the box's cells, beside that of the depth.
double relative_error(const Scene& scene, const LightSource& light, int resolution, Scheme scheme, bool halves = false) {
  const MediumBox box = medium_box(scene, resolution);
  const Volume volume = propagate(scene, box, light, scheme, halves);
  double error = 0, all = 0;
  for (int n = 0; n < 4000; ++n) {
    const auto i = static_cast<std::uint32_t>(n);
    const glm::dvec3 local = box.size() * glm::dvec3(uniform(612, 3 * i), uniform(612, 3 * i + 1), uniform(612, 3 * i + 2));
    const glm::dvec3 place = box.corner + local;
    const bool sun = light.type == LightType::directional;
    const glm::dvec3 from = sun ? place - light.direction * 1e3 : light.position;
    const double truth = optical_depth(scene.medium.gaussians, from, place);
    const double found = static_cast<double>(volume.at(local));
    error += (found - truth) * (found - truth);
    all += truth * truth;
  }
  return std::sqrt(error / all);
}

struct Placed {
  const char* name;
  LightSource light;
};

std::vector<Placed> lights() {
  LightSource sun;
  sun.type = LightType::directional;
  sun.direction = glm::normalize(glm::dvec3(0.4, -0.8, 0.3));
  return {{"in the middle", light_at({0.5, 0.5, 0.5})},   {"inside", light_at({0.31, 0.62, 0.44})},
          {"at the border", light_at({-0.02, 0.4, 0.6})}, {"outside", light_at({-0.6, 1.5, 0.2})},
          {"far away", light_at({30, 40, 20})},           {"the sun", sun}};
}

TEST(DepthVolumes, AreRightWhereverTheLightIs) {
  for (const int count : {1, 40}) {
    const Scene scene = blobs(count);
    for (const Placed& placed : lights()) {
      double errors[2][4];
      for (const int fine : {0, 1}) {
        for (const Scheme scheme : {Scheme::rays, Scheme::rays_through_volume, Scheme::upwind, Scheme::published}) {
          errors[fine][static_cast<int>(scheme)] = relative_error(scene, placed.light, fine ? 64 : 32, scheme);
        }
      }
      std::printf("%2d blobs, light %-14s", count, placed.name);
      for (const int fine : {0, 1}) {
        std::printf(" %d^3: rays %.3f %%, through a volume %.3f %%, upwind %.2f %%, published %.1f %%;", fine ? 64 : 32,
                    100 * errors[fine][0], 100 * errors[fine][1], 100 * errors[fine][2], 100 * errors[fine][3]);
      }
      std::printf("\n");
      for (const int n : {0, 1}) {
        EXPECT_FALSE(!(errors[0][n] < tolerance("depth_volume_32"))) << placed.name;
        EXPECT_FALSE(!(errors[1][n] < tolerance("depth_volume_64"))) << placed.name;
      }
      EXPECT_LT(errors[1][2], errors[0][2]) << "the consistent scheme converges";
      EXPECT_LT(errors[1][1], errors[1][2]);
    }
  }
}

// At the centre of a cell, in the middle of its faces and at its corners no scheme divides by nothing or takes a neighbour that
// the light does not shine through.
TEST(DepthVolumes, AreRightWithLightsOnCells) {
  const Scene scene = blobs(40);
  const MediumBox box = medium_box(scene, 32);
  for (const glm::dvec3 part : {glm::dvec3(0.5), glm::dvec3(0, 0.5, 0.5), glm::dvec3(0.5, 0, 0.5), glm::dvec3(0.5, 0.5, 0),
                                glm::dvec3(0, 0, 0.5), glm::dvec3(0)}) {
    const LightSource light = light_at(box.corner + (glm::dvec3(14, 17, 15) + part) * box.cell);
    const LightSource beside = light_at(light.position + glm::dvec3(0.23, 0.31, 0.17) * box.cell);
    double errors[4];
    for (const Scheme scheme : {Scheme::rays, Scheme::rays_through_volume, Scheme::upwind, Scheme::published})
      errors[static_cast<int>(scheme)] = relative_error(scene, light, 32, scheme);
    const double upwind = relative_error(scene, beside, 32, Scheme::upwind);
    std::printf(
        "%g, %g, %g of a cell: rays %.3f %%, through a volume %.3f %%, upwind %.2f %% (beside it %.2f %%), published %.1f %%\n",
        part.x, part.y, part.z, 100 * errors[0], 100 * errors[1], 100 * errors[2], 100 * upwind, 100 * errors[3]);
    for (const int n : {0, 1}) EXPECT_FALSE(!(errors[n] < tolerance("depth_volume_32")));
    EXPECT_FALSE(!(errors[2] < 2 * upwind));
    EXPECT_TRUE(std::isfinite(errors[3]));
  }
}

// The light at one end of the table's ways, what is looked up at the other; beside the lines through the centres, of which a way
// far from all has next to nothing.
TEST(DepthVolumes, AreRightOnTheTable) {
  for (const int resolution : {32, 64}) {
    double sum = 0, worst = 0;
    int resolved = 0;
    const std::vector<WayThroughGaussians> ways = optical_depth_table();
    for (const WayThroughGaussians& way : ways) {
      Scene scene;
      scene.medium.gaussians = way.gaussians;
      const MediumBox box = medium_box(scene, resolution);
      double smallest = way.gaussians.front().radius;
      for (const Gaussian& g : way.gaussians) smallest = std::min(smallest, g.radius);
      if (smallest < 3 * box.cell) continue;
      const Volume volume = propagate(scene, box, light_at(way.from), Scheme::rays, false);
      const double found = static_cast<double>(volume.at(way.to - box.corner));
      const double error = std::fabs(found - way.optical_depth) / lines_through_centers(way.gaussians);
      sum += error * error;
      worst = std::max(worst, error);
      ++resolved;
    }
    const double mean = std::sqrt(sum / resolved);
    std::printf("optical_depth.csv, %d^3: %d of %zu ways with radii of three cells, RMS %.4f %%, largest %.4f %%\n", resolution,
                resolved, ways.size(), 100 * mean, 100 * worst);
    EXPECT_GT(resolved, 10);
    EXPECT_FALSE(!(mean < tolerance(resolution == 32 ? "depth_volume_32" : "depth_volume_64")));
  }
}

// What 16 bits a value add: at most 2^-11 of each.
TEST(DepthVolumes, AreRightInHalves) {
  const Scene scene = blobs(40);
  for (const Placed& placed : lights()) {
    std::printf("in 16 bits, light %-14s", placed.name);
    for (const int resolution : {32, 64}) {
      for (const Scheme scheme : {Scheme::rays, Scheme::rays_through_volume}) {
        const double whole = relative_error(scene, placed.light, resolution, scheme);
        const double error = relative_error(scene, placed.light, resolution, scheme, true);
        std::printf(" %d^3: %.4f %% (%.4f %%)", resolution, 100 * error, 100 * whole);
        EXPECT_FALSE(!(error < tolerance(resolution == 32 ? "depth_volume_32" : "depth_volume_64"))) << placed.name;
        EXPECT_FALSE(!(error < whole + tolerance("depth_in_halves"))) << placed.name;
        EXPECT_NE(error, whole) << placed.name;
      }
    }
    std::printf("\n");
  }
}

}  // namespace
}  // namespace airlight
