// What of illumination-network is made of a scene's Gaussians: particles, each of them one, and bricks of nodes where small ones
// lie far apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/airlight.h"
#include "common/error.h"
#include "common/plan/geometry.h"
#include "common/plan/source_nodes.h"
#include "tests/parity/medium.h"
#include "tests/tolerances.h"
#include "tests/truth/network_error.h"
#include "tests/unit/network_ran.h"

namespace airlight {

namespace {

// At the Gaussian's centre, with its mass, its albedo and what it glows where it is alone. Those that are none are left out.
TEST(NetworkGaussians, EachIsAParticle) {
  Scene scene = test_gaussian_scene(40);
  for (std::size_t k = 0; k < 40; ++k) scene.medium.gaussians[k].center.x += 20 * static_cast<double>(k % 8);
  scene.medium.gaussians[7].extinction = 0;
  const NetworkFrame frame = network_frame(medium_box(scene, 16));
  const int count = gaussian_particles(scene);
  EXPECT_EQ(count, 39);
  const auto n = static_cast<std::size_t>(count);
  const std::vector<float> planes = network_particles(scene, frame, count, ParticleSet::gaussians);
  const auto value = [&](std::size_t plane, std::size_t v) { return static_cast<double>(planes[plane * n + v]); };
  const auto mass = [](const Gaussian& g) { return g.extinction * std::pow(g.radius, 3); };
  double mean = 0;
  for (const Gaussian& g : scene.medium.gaussians) mean += mass(g) / count;
  int alone = 0;
  for (const Gaussian& g : scene.medium.gaussians) {
    if (g.extinction == 0) continue;
    std::size_t nearest = 0;
    double least = 1e9;
    for (std::size_t v = 0; v < n; ++v) {
      const glm::dvec3 place = frame.middle + glm::dvec3(value(0, v), value(1, v), value(2, v)) * frame.unit;
      if (const double away = glm::length(place - g.center); away < least) least = away, nearest = v;
    }
    EXPECT_LE(least, frame.unit);
    EXPECT_NEAR(value(particle_mass, nearest) * mean / mass(g), 1, 1e-6);
    const bool others = std::any_of(scene.medium.gaussians.begin(), scene.medium.gaussians.end(), [&](const Gaussian& other) {
      return &other != &g && glm::length(other.center - g.center) < static_cast<double>(gaussian_reach(other, 1e-5));
    });
    if (others) continue;
    ++alone;
    for (std::size_t c = 0; c < 3; ++c) {
      const int channel = static_cast<int>(c);
      EXPECT_NEAR(value(particle_albedo + c, nearest), g.albedo[channel], 1e-6);
      EXPECT_NEAR(value(particle_glow + c, nearest), g.emission[channel] / g.extinction, 0.01 * g.emission[channel]);
    }
  }
  EXPECT_GT(alone, 3);
}

// Beside particles sampled from the same cloud.
TEST(NetworkGaussians, AreTheirMedium) {
  Scene scene = particle_cloud(200);
  for (std::size_t k = 0; k < 200; ++k) {
    Gaussian& g = scene.medium.gaussians[k];
    g.radius *= k % 2 == 0 ? 1.2 : 0.7;
    g.albedo = glm::dvec3(g.center.x > 0 ? 0.95 : 0.5);
  }
  const auto render = [&](const NetworkSize& size) {
    RenderSettings settings = network_settings(size, {12, 9});
    settings.images = {"airlight"};
    return Renderer({.backend = "cpu"}).render(scene, settings).image("airlight").values;
  };
  const std::vector<float> each = render({200, 64, 16, "fibonacci", "gaussians"}), sampled = render({2048, 64, 16});
  double squares = 0, sum = 0;
  for (std::size_t k = 0; k < each.size(); ++k) {
    squares += std::pow(static_cast<double>(each[k]) - static_cast<double>(sampled[k]), 2);
    sum += static_cast<double>(sampled[k]);
  }
  const double error = std::sqrt(squares * static_cast<double>(each.size())) / sum;
  std::printf("%g apart\n", error);
  EXPECT_FALSE(!(error <= tolerance("network_each_gaussian")));
}

TEST(NetworkGaussians, BadMediaAreRefused) {
  Scene scene = two_gaussians(0.9);
  scene.lights = network_lights();
  RenderSettings settings;
  settings.technique = "illumination-network";
  settings.knobs = {{"particle_set", "gaussians"}, {"directions", "6"}, {"resolution", "4"}, {"steps", "4"}};
  settings.resolution = Extent{8, 6};
  const auto refused = [&] {
    Renderer renderer({.backend = "cpu"});
    try {
      renderer.render(scene, settings);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(refused(), "nothing");
  scene.medium.grid = test_grid();
  EXPECT_EQ(refused(),
            "setting particle_set: gaussians leave the grid without particles; expected a medium of Gaussians alone, or "
            "particle_set=sampled");
  scene.medium.grid.reset();
  scene.medium.gaussians.assign(100001, scene.medium.gaussians[0]);
  for (Gaussian& g : scene.medium.gaussians) g.center.x += 1e-5 * static_cast<double>(&g - scene.medium.gaussians.data());
  EXPECT_EQ(refused(),
            "setting particle_set: gaussians would be 100001 particles; expected at most 100000, or particle_set=sampled");
  settings.knobs[0].second = "balls";
  EXPECT_NE(refused().find("particle_set"), std::string::npos);
}

// Wherever a small Gaussian matters there are nodes, and few elsewhere.
TEST(NetworkGaussians, BricksAreWhereTheMediumIs) {
  Scene scene = far_gaussians();
  const NetworkFrame frame = network_frame(medium_box(scene, 32));
  const SourceNodes nodes = source_nodes(scene, frame, 32);
  const glm::ivec3 cells = nodes.nodes - 1;
  EXPECT_FALSE(nodes.too_coarse);
  EXPECT_LE(nodes.stride * frame.unit, 0.04);
  EXPECT_LE(nodes.filled.size() * 125, 33U * 33U * 33U);
  EXPECT_TRUE(std::is_sorted(nodes.filled.begin(), nodes.filled.end()));
  for (const Gaussian& g : scene.medium.gaussians) {
    const auto reach = static_cast<double>(gaussian_reach(g, 1e-3));
    for (int i = 0; i < 1000; ++i) {
      const glm::dvec3 unit = glm::dvec3(i % 10, i / 10 % 10, i / 100) / 4.5 - 1.0;
      if (glm::length(unit) > 1) continue;
      const glm::dvec3 at = (g.center + reach * unit - frame.middle) / frame.unit - glm::dvec3(nodes.first);
      const glm::ivec3 brick = glm::floor(at / static_cast<double>(nodes.stride) / glm::dvec3(cells));
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(brick, glm::ivec3(0))) && glm::all(glm::lessThan(brick, nodes.bricks)));
      const int number = brick.x + nodes.bricks.x * (brick.y + nodes.bricks.y * brick.z);
      EXPECT_TRUE(std::binary_search(nodes.filled.begin(), nodes.filled.end(), number));
    }
  }
  // One cloud has one box, and so has one beside which little is left for bricks.
  EXPECT_EQ(source_nodes(two_gaussians(1), network_frame(medium_box(two_gaussians(1), 32)), 32).filled.size(), 1U);
  EXPECT_EQ(source_nodes(scene, frame, 4).filled.size(), 1U);
  EXPECT_TRUE(source_nodes(scene, frame, 4).too_coarse);
}

// Nodes of bricks are what one box has there, to the bit, those at sides beyond which there is another brick as well.
TEST(NetworkGaussians, BricksAreThoseOfABox) {
  Case c;
  const TestNetwork t = test_network(c, far_gaussians(), network_lights(),
                                     {.particles = 100, .lines = 7, .window = 4, .iterations = 4, .sparse = true});
  SourceFunction box = t.source;
  const glm::ivec3 cells = glm::ivec3(box.nodes) - 1, bricks = box.bricks;
  box.nodes = cells * bricks + 1, box.bricks = glm::vec3(1), box.filled = {0};
  box.sources = {{30}, sizeof(float) * box.floats()};
  c.steps = {{t.network, ""}, {t.light, ""}, {t.iteration, ""}, {t.source, ""}, {box, ""}};
  CpuBackend backend(CpuOptions{.threads = 2});
  upload(backend, c);
  Stats stats;
  NoProgress progress;
  backend.run(c.steps, stats, progress);
  const std::vector<float> some = download(backend, t.source.sources), all = download(backend, box.sources);
  const auto filled = [&](const glm::ivec3& b) {
    const std::int32_t number = b.x + bricks.x * (b.y + bricks.y * b.z);
    return std::binary_search(t.source.filled.begin(), t.source.filled.end(), number);
  };
  int compared = 0, beside = 0;
  for (std::size_t k = 0; k < t.source.filled.size(); ++k) {
    const auto [x, y, z] = t.source.brick(k);
    for (int n = 0; n < 125; ++n) {
      const glm::ivec3 within(n % 5, n / 5 % 5, n / 25), brick(x, y, z), at = brick * cells + within;
      bool whole = true, inner = true;
      for (int axis = 0; axis < 3; ++axis) {
        if (within[axis] != 0 && within[axis] != cells[axis]) continue;
        glm::ivec3 next = brick;
        next[axis] += within[axis] == 0 ? -1 : 1;
        inner = false;
        whole = whole && (next[axis] < 0 || next[axis] >= bricks[axis] || filled(next));
      }
      if (!whole) continue;
      const glm::ivec3 size = box.nodes;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::size_t of_box =
            static_cast<std::size_t>(at.x + size.x * (at.y + size.y * (at.z + size.z * static_cast<int>(channel))));
        ASSERT_EQ(some[t.source.head_floats() + 125 * (3 * k + channel) + static_cast<std::size_t>(n)],
                  all[box.head_floats() + of_box]);
      }
      ++compared;
      if (!inner) ++beside;
    }
  }
  std::printf("%zu of %d bricks, %d nodes, %d of them beside another brick\n", t.source.filled.size(),
              bricks.x * bricks.y * bricks.z, compared, beside);
  EXPECT_GT(beside, 50);
}

}  // namespace

}  // namespace airlight
