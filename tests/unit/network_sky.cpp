// An environment in an illumination network.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

#include "common/plan/network.h"
#include "common/reference/environment.h"
#include "tests/tolerances.h"
#include "tests/unit/network_ran.h"

namespace airlight {

namespace {

constexpr double pi = std::numbers::pi;

// Where the same comes from everywhere and nothing is absorbed, every source and everything that arrives is that.
void in_a_furnace(const Phase& phase, DirectionSet set = DirectionSet::fibonacci) {
  Scene scene = two_gaussians(1);
  scene.environment = Environment{.image = nullptr, .radiance = {1, 2, 0.5}};
  const NetworkParts parts{
      .particles = 200, .lines = 20, .window = 5, .phase = phase, .extinction = 0, .tolerance = 1e-5F, .set = set};
  const RanNetwork ran(scene, {}, parts, true);
  double sources = 0, field = 0;
  for (std::size_t i = 0; i < ran.sources.size(); ++i) {
    if (i % 4 < 3)
      sources = std::max(
          sources, std::fabs(static_cast<double>(ran.sources[i]) / scene.environment->radiance[static_cast<int>(i % 4)] - 1));
  }
  const std::size_t nodes = ran.t.source.all_nodes(), head = ran.t.source.head_floats();
  for (std::size_t i = 0; i < 3 * nodes; ++i)
    field = std::max(
        field,
        std::fabs(static_cast<double>(ran.everywhere[head + i]) / scene.environment->radiance[static_cast<int>(i / nodes)] - 1));
  std::printf("sources off by %.1e, what arrives by %.1e after %g rounds\n", sources, field,
              static_cast<double>(ran.residuals[0]));
  const bool isotropic = phase.kind == PhaseKind::isotropic;
  if (isotropic) {
    EXPECT_LE(sources, tolerance("network_furnace"));
  }
  EXPECT_LE(field, tolerance(isotropic ? "network_furnace" : "network_furnace_forward"));
}

TEST(NetworkSky, AFurnaceIsAllThatIsSeen) { in_a_furnace({}); }
TEST(NetworkSky, AFurnaceIsAllThatIsSeenForward) { in_a_furnace({PhaseKind::henyey_greenstein, 0.7}); }
TEST(NetworkSky, AFurnaceIsAllThatIsSeenAtRandom) { in_a_furnace({}, DirectionSet::random); }

// Of random directions some lie so near to each other that nothing is left for one of them.
TEST(NetworkSky, EvenSkyComesFromEveryRandomDirection) {
  const Environment environment{.image = nullptr, .radiance = {1, 2, 0.5}};
  const std::vector<float> sky = network_sky(environment, 512, DirectionSet::random);
  float off = 0;
  for (std::size_t i = 0; i < sky.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c)
      off = std::max(off, std::fabs(sky[i + c] / static_cast<float>(environment.radiance[static_cast<int>(c)]) - 1));
  }
  std::printf("off by %g\n", static_cast<double>(off));
  EXPECT_FALSE(!(off <= 1e-6F));
}

// All of the environment comes, from where it is.
TEST(NetworkSky, DirectionsShareAllOfIt) {
  const Environment environment = network_environment();
  constexpr int lines = 40;
  const std::vector<float> sky = network_sky(environment, lines);
  const std::vector<glm::dvec3> directions = network_directions(lines);
  ASSERT_EQ(sky.size(), 8U * lines);
  glm::dvec3 in_all(0), found_way(0), all(0), way(0);
  for (std::size_t d = 0; d < 2 * lines; ++d) {
    const glm::dvec3 radiance(sky[4 * d], sky[4 * d + 1], sky[4 * d + 2]);
    in_all += radiance * (4 * pi / (2 * lines));
    found_way += radiance.x * (4 * pi / (2 * lines)) * (d % 2 == 0 ? -directions[d / 2] : directions[d / 2]);
  }
  // The reference's environment, direction by direction.
  const EnvironmentLighting truth(environment);
  constexpr int rows = 200;
  for (int y = 0; y < rows; ++y) {
    const double polar = pi * (y + 0.5) / rows, angle = (std::cos(pi * y / rows) - std::cos(pi * (y + 1) / rows)) * pi / rows;
    for (int x = 0; x < 2 * rows; ++x) {
      const double azimuth = pi * (x + 0.5) / rows;
      const glm::dvec3 d(std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth));
      all += angle * truth.radiance(d);
      way += angle * truth.radiance(d).x * d;
    }
  }
  double off = 0;
  for (int c = 0; c < 3; ++c) off = std::max(off, std::fabs(in_all[c] / all[c] - 1));
  const double turned = glm::length(found_way - way) / glm::length(way);
  std::printf("all of it off by %.1e, where it comes from by %.1e\n", off, turned);
  EXPECT_LE(off, tolerance("network_sky_all"));
  EXPECT_LE(turned, tolerance("network_sky_way"));
}

}  // namespace

}  // namespace airlight
