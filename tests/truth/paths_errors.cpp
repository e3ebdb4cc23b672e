// What the reference's random paths say of their own errors, and that they are the same whoever computes them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

#include "common/error.h"
#include "tests/truth/path_scenes.h"

namespace airlight {

using namespace path_test;

namespace {

TEST(Paths, SameBitsForAnyThreadsAndOrder) {
  const Scene scene = everything();
  const ReferenceFrame one = rendered(scene, settings(5, 20), 1), three = rendered(scene, settings(5, 20), 3);
  const ReferenceFrame other = rendered(scene, settings(5, 20, false, 1), 3);
  int differ = 0;
  for (std::size_t i = 0; i < one.pixels.size(); ++i) {
    EXPECT_EQ(std::memcmp(&one.pixels[i].airlight, &three.pixels[i].airlight, sizeof(glm::dvec3)), 0);
    EXPECT_EQ(std::memcmp(&one.pixels[i].standard_error, &three.pixels[i].standard_error, sizeof(glm::dvec3)), 0);
    differ += one.pixels[i].airlight != other.pixels[i].airlight ? 1 : 0;
  }
  // Nor does the order matter, or what was rendered before.
  const Reference alone(scene, settings(5, 20));
  for (std::size_t i = one.pixels.size(); i-- > 0;) {
    const auto width = static_cast<std::size_t>(small.width);
    const glm::dvec2 at(static_cast<double>(i % width) + 0.5, static_cast<double>(i / width) + 0.5);
    const glm::dvec3 again = alone.pixel(at, small).airlight;
    EXPECT_EQ(std::memcmp(&one.pixels[i].airlight, &again, sizeof(glm::dvec3)), 0);
  }
  EXPECT_EQ(differ, 48);  // another seed gives other paths
}

// Images of other seeds lie about each other as their errors say, and four times the paths leave a quarter of the variance.
TEST(Paths, StandardErrorIsTrue) {
  const Scene scene = gaussians();
  constexpr int seeds = 8;
  double variance[2] = {};
  for (const int k : {0, 1}) {
    std::vector<ReferenceFrame> frames;
    for (std::uint32_t seed = 0; seed < seeds; ++seed)
      frames.push_back(rendered(scene, settings(4, k == 0 ? 40 : 160, false, seed)));
    double told = 0, chi = 0;
    const std::size_t pixels = frames[0].pixels.size();
    for (std::size_t i = 0; i < pixels; ++i) {
      double sum = 0, squares = 0, error = 0;
      for (const ReferenceFrame& f : frames) {
        const double value = f.pixels[i].airlight.y, one = f.pixels[i].standard_error.y;
        sum += value, squares += value * value, error += one * one / seeds;
      }
      const double spread = (squares - sum * sum / seeds) / (seeds - 1);
      variance[k] += spread, told += error, chi += (seeds - 1) * spread / error;
    }
    const double degrees = static_cast<double>(pixels) * (seeds - 1);
    std::printf("%d paths: chi-square %.0f of %.0f degrees; variance %.3g, told %.3g\n", k == 0 ? 40 : 160, chi, degrees,
                variance[k], told);
    EXPECT_FALSE(!(std::fabs(chi / degrees - 1) <= 5 * std::sqrt(2 / degrees)));
    EXPECT_FALSE(!(std::fabs(variance[k] / told - 1) <= 0.25));
  }
  std::printf("four times the paths: variance %.2f times smaller\n", variance[0] / variance[1]);
  EXPECT_FALSE(!(std::fabs(variance[0] / variance[1] / 4 - 1) <= 0.25));
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
