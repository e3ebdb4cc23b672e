// The directions of an illumination network, and what is told of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "common/algorithms/particle_splats.h"
#include "common/plan/network.h"
#include "tests/tolerances.h"
#include "tests/unit/network_ran.h"

namespace airlight {

namespace {

// Random directions: unit vectors, even over all axes, the same however many there are, none so far apart that a splat's way to
// the camera has none within reach.
TEST(NetworkDirections, RandomOnesAreEven) {
  constexpr int most = 512;
  const std::vector<glm::dvec3> all = network_directions(most, DirectionSet::random), ways = network_directions(2000);
  glm::dmat3 squares(0);
  for (const glm::dvec3& d : all) {
    EXPECT_NEAR(glm::length(d), 1, 1e-12);
    squares += glm::outerProduct(d, d) / static_cast<double>(most);
  }
  double worst = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) worst = std::max(worst, std::fabs(squares[i][j] - (i == j ? 1.0 / 3 : 0.0)));
  }
  std::printf("second moments off by %g\n", worst);
  EXPECT_LE(worst, tolerance("random_direction_moments"));
  for (const int count : {1, 2, 4, 8, 32, 128, most}) {
    const std::vector<glm::dvec3> some = network_directions(count, DirectionSet::random);
    EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin()));
    ParticleSplats splats;
    splats.line_count = count, splats.random_directions = true, splats.phase = {PhaseKind::henyey_greenstein, 0.5};
    double farthest = 0;
    for (const glm::dvec3& way : ways) {
      double nearest = 2;
      for (const glm::dvec3& d : some) nearest = std::min({nearest, glm::length(way - d), glm::length(way + d)});
      farthest = std::max(farthest, nearest);
    }
    EXPECT_LT(farthest, 1 / static_cast<double>(splats.inverse_reach())) << count;
  }
}

// However wide directions lie beside a phase function's peak, a particle scatters as much of lights in all of them as where it
// scatters evenly.
TEST(NetworkDirections, FirstLightIsAllOfIt) {
  const RanNetwork even(two_gaussians(0.9), network_lights(), {.particles = 50, .lines = 32, .window = 3, .iterations = 1});
  for (const Phase& phase :
       {Phase{PhaseKind::henyey_greenstein, 0.8}, Phase{PhaseKind::henyey_greenstein, -0.5}, Phase{PhaseKind::rayleigh, 0}}) {
    const RanNetwork ran(two_gaussians(0.9), network_lights(),
                         {.particles = 50, .lines = 32, .window = 3, .phase = phase, .iterations = 1});
    double worst = 0;
    for (std::size_t v = 0; v < 4 * ran.shape.particles; ++v) {
      if (v % 4 == 3) continue;
      double mean = 0;
      for (std::size_t d = 0; d < 64; ++d) mean += static_cast<double>(ran.first[4 * ran.shape.particles * d + v]) / 64;
      worst = std::max(worst, std::fabs(mean / static_cast<double>(even.first[v]) - 1));
    }
    std::printf("phase function %d: first light in all directions off by %g\n", static_cast<int>(phase.kind), worst);
    EXPECT_LE(worst, tolerance("network_first_light"));
  }
}

}  // namespace

}  // namespace airlight
