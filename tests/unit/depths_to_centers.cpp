// Depths to all centres by a sweep beside the sum over all pairs, on sets that are random and on sets that are hostile to it.
#include "common/plan/depths_to_centers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/plan/geometry.h"
#include "tests/parity/inputs.h"
#include "tests/tolerances.h"

namespace airlight {
namespace {

using Gaussians = std::vector<GaussianDensity>;

// With the reach that scenes give them.
Gaussians with_reach(const std::vector<glm::dvec3>& centers, const std::function<double(std::size_t)>& radius,
                     double extinction = 1) {
  Scene scene;
  for (std::size_t i = 0; i < centers.size(); ++i)
    scene.medium.gaussians.push_back({.center = centers[i], .radius = radius(i), .extinction = extinction});
  return gaussians_of(scene, {0, 0, 0});
}

std::vector<glm::dvec3> places(std::uint32_t stream, std::size_t count, const glm::dvec3& middle, const glm::dvec3& half) {
  std::vector<glm::dvec3> all;
  for (std::uint32_t i = 0; i < count; ++i) {
    const glm::dvec3 u(uniform(stream, 3 * i), uniform(stream, 3 * i + 1), uniform(stream, 3 * i + 2));
    all.push_back(middle + half * (2.0 * u - 1.0));
  }
  return all;
}

double squared(double x) { return x * x; }

// By the C library. What is left out has its whole line in `lost`, what is met in `met`.
struct Sum {
  double depth = 0, met = 0;
  int lost = 0;

  void add(const GaussianDensity& g, const glm::dvec3& from, const glm::dvec3& way, double length) {
    const glm::dvec3 c = glm::dvec3(g.center) - from;
    const double foot = glm::dot(c, way), h2 = squared(glm::length(glm::cross(c, way)));
    const auto radius = static_cast<double>(g.radius), reach = static_cast<double>(g.reach);
    const double whole = static_cast<double>(g.extinction) * radius * std::sqrt(std::numbers::pi);
    const double all =
        whole / 2 * std::exp(-h2 / squared(radius)) * (std::erf((length - foot) / radius) - std::erf(-foot / radius));
    if (h2 + squared(foot - std::clamp(foot, 0.0, length)) < squared(reach)) {
      depth += all, met += whole;
    } else {
      EXPECT_LT(all, tolerance("left_out_depth") * std::min(1.0, whole));
      ++lost;
    }
  }
};

struct Direction {
  bool from_infinity;
  glm::vec3 travel{0, 0, 0};
};

void compare(const char* name, const Gaussians& all, const Direction& d) {
  const CenterDepths found = d.from_infinity ? depths_to_centers(all, d.travel) : depths_to_centers(all);
  ASSERT_EQ(found.others.size(), all.size());
  ASSERT_EQ(found.own.size(), all.size());
  double largest = 0;
  std::uint64_t pairs = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const glm::dvec3 center(all[i].center);
    const double length = d.from_infinity ? 1e300 : glm::length(center);
    const glm::dvec3 from = d.from_infinity ? center : glm::dvec3(0);
    const glm::dvec3 way = d.from_infinity ? -glm::normalize(glm::dvec3(d.travel))
                           : length > 0    ? center / length
                                           : glm::dvec3(0, 1, 0);
    Sum others, own;
    for (std::size_t j = 0; j < all.size(); ++j) (j == i ? own : others).add(all[j], from, way, length);
    pairs += all.size() - static_cast<std::size_t>(others.lost + own.lost);
    const double error = std::fabs(found.others[i] - others.depth), own_error = std::fabs(found.own[i] - own.depth);
    // Beside the whole lines of what is met: single precision.
    const double beside = std::max(error / std::max(others.met, 1e-300), own_error / std::max(own.met, 1e-300));
    largest = std::max(largest, beside);
    EXPECT_FALSE(!(beside <= tolerance("gaussian_depth"))) << name << ", " << i << ": " << found.others[i] << ' ' << others.depth;
  }
  EXPECT_GE(found.visited, pairs) << name;
  std::printf("%-24s %s %5zu Gaussians, %8llu pairs met, %8llu visited, error %.1e of the lines met\n", name,
              d.from_infinity ? "from infinity," : "from a place, ", all.size(), static_cast<unsigned long long>(pairs),
              static_cast<unsigned long long>(found.visited), largest);
}

void compare(const char* name, const Gaussians& all) {
  compare(name, all, {false});
  for (const glm::vec3 travel :
       {glm::vec3(0, -1, 0), glm::vec3(1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0.6F, 0, -0.8F), glm::vec3(0.3F, -1, -0.2F)})
    compare(name, all, {true, travel});
}

TEST(DepthsToCenters, OfRandomSets) {
  for (const double scale : {1e-3, 1.0, 1e4}) {
    const auto radius = [&](std::size_t i) { return scale * (0.02 + 0.3 * uniform(41, static_cast<std::uint32_t>(i))); };
    compare("around", with_reach(places(42, 250, {0, 0, 0}, glm::dvec3(3 * scale)), radius, 1 / scale));
    compare("before", with_reach(places(43, 250, glm::dvec3(0, 0, -8) * scale, glm::dvec3(2 * scale)), radius, 1 / scale));
  }
  compare("strong and weak", with_reach(
                                 places(44, 200, {0, 0, -5}, glm::dvec3(3)), [](std::size_t) { return 0.2; }, 1e4));
  compare("many", with_reach(places(45, 700, {1, 2, 3}, glm::dvec3(5)), [](std::size_t) { return 0.1; }));
}

TEST(DepthsToCenters, OfHostileSets) {
  const auto some = [](std::size_t i) { return 0.05 + 0.1 * static_cast<double>(i % 5); };
  compare("none", {});
  compare("one", with_reach({{1, 2, -3}}, some));
  compare("at the origin", with_reach({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}}, some));
  compare("coincident", with_reach(std::vector<glm::dvec3>(60, {0.3, -0.2, 1.5}), some));
  compare("origin inside of all", with_reach(places(46, 150, {0, 0, 0}, glm::dvec3(1)), [](std::size_t) { return 2.0; }));
  compare("far and tiny", with_reach(places(47, 200, {2000, 30, 0}, {1e-3, 1e-3, 1e-3}), [](std::size_t) { return 1e-4; }));
  // Poles: on the axis, close to it, and cones that begin, hold or just miss one.
  std::vector<glm::dvec3> poles;
  for (int i = 1; i <= 40; ++i) {
    poles.emplace_back(0, i % 2 == 0 ? i : -i, 0);
    poles.emplace_back(1e-9 * i, 2 + i, -1e-10 * i);
    poles.emplace_back(0.4 * std::cos(i), 3 + 0.05 * i, 0.4 * std::sin(i));
    poles.emplace_back(0.06 * i, -4, 0.01 * i);
  }
  compare("poles", with_reach(poles, some));
  // Where the angle begins again: on the half plane of +X, and to both sides of it.
  std::vector<glm::dvec3> seam;
  for (int i = 0; i < 120; ++i) seam.emplace_back(2 + 0.03 * i, 0.02 * (i % 9) - 0.08, (i % 3 - 1) * 0.004 * i);
  compare("seam", with_reach(seam, some));
  // The same about every axis and half-axis, where an angle's sign changes.
  std::vector<glm::dvec3> axes;
  for (int i = 0; i < 30; ++i) {
    for (const double sign : {-1.0, 1.0}) {
      axes.emplace_back(sign * (1 + i), 0, 0);
      axes.emplace_back(0, 0, sign * (1 + i));
      axes.emplace_back(sign * (1 + i), 0, sign * -1e-13 * i);
    }
  }
  compare("axes", with_reach(axes, some));
  // Half the sphere and more.
  compare("wide cones", with_reach(places(48, 150, {0, 0, 0}, glm::dvec3(4)), [](std::size_t) { return 0.6; }));
}

TEST(DepthsToCenters, ToPlacesAndDirections) {
  const Gaussians all = with_reach(places(49, 300, {0, 0, -3}, glm::dvec3(4)), [](std::size_t) { return 0.3; });
  for (const glm::dvec3 place : {glm::dvec3(0, 0, -3), glm::dvec3(2, -1, -5), glm::dvec3(0, 0, 0)}) {
    const double length = glm::length(place);
    const glm::dvec3 way = length > 0 ? place / length : glm::dvec3(1, 0, 0);
    Sum to, toward;
    for (const GaussianDensity& g : all) to.add(g, {0, 0, 0}, way, length), toward.add(g, {0, 0, 0}, way, 1e300);
    EXPECT_NEAR(depth_to(all, place), to.depth, tolerance("gaussian_depth") * to.met);
    EXPECT_NEAR(depth_toward(all, way), toward.depth, tolerance("gaussian_depth") * toward.met);
    if (length > 0) {
      EXPECT_GT(toward.depth, to.depth);
    }
  }
}

// Work grows with n where as many Gaussians stand in a way whatever n is; with n^(4/3) where they touch in space.
TEST(DepthsToCenters, WorkGrowsWithWhatIsMet) {
  for (const bool touching : {false, true}) {
    double before = 0, last = 0;
    for (const std::size_t n : {10U, 100U, 1000U, 10000U, 100000U, 300000U}) {
      if (touching && n > 100000) continue;
      const auto count = static_cast<double>(n);
      const double radius = touching ? 0.15 / std::cbrt(count) : 0.3 / std::sqrt(count);
      const Gaussians all = with_reach(places(50, n, {0, 0, -4}, glm::dvec3(1)), [&](std::size_t) { return radius; });
      const CenterDepths d = depths_to_centers(all);
      const auto visited = static_cast<double>(d.visited);
      const double exponent = std::log(visited / before) / std::log(count / last);
      std::printf("%s %6zu Gaussians: %9.0f pairs visited, %5.1f each%s", touching ? "touching," : "as many,  ", n, visited,
                  visited / count, last > 0 ? "" : "\n");
      if (last > 0) std::printf(", exponent %.3f\n", exponent);
      if (last >= 100) {
        EXPECT_NEAR(exponent, touching ? 4.0 / 3 : 1.0, tolerance("depths_exponent")) << n;
      }
      before = visited, last = count;
    }
  }
}

}  // namespace
}  // namespace airlight
