// Panels: that nothing which matters to a ray is missing from their lists.
#include "common/plan/gaussian_panels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <set>

#include "common/plan/geometry.h"
#include "tests/parity/inputs.h"
#include "tests/parity/medium.h"

namespace airlight {
namespace {

TEST(GaussLegendre, IntegratesPolynomialsOfTwiceItsOrder) {
  double worst = 0;
  for (int n = 1; n <= GaussianAirlight::most_samples; ++n) {
    const GaussLegendre rule(n);
    ASSERT_EQ(rule.node.size(), static_cast<std::size_t>(n));
    EXPECT_TRUE(std::is_sorted(rule.node.begin(), rule.node.end()));
    for (int power = 0; power < 2 * n; ++power) {
      double sum = 0;
      for (std::size_t i = 0; i < rule.node.size(); ++i)
        sum += static_cast<double>(rule.weight[i]) * std::pow(static_cast<double>(rule.node[i]), power);
      worst = std::max(worst, std::fabs(sum - (power % 2 == 0 ? 2.0 / (power + 1) : 0)));
    }
    double beyond = 0;  // the next power it cannot
    for (std::size_t i = 0; i < rule.node.size(); ++i)
      beyond += static_cast<double>(rule.weight[i]) * std::pow(static_cast<double>(rule.node[i]), 2 * n);
    if (n < 8) {
      EXPECT_GT(std::fabs(beyond - 2.0 / (2 * n + 1)), 1e-5) << n;
    }
  }
  std::printf("largest error %.2g\n", worst);
  EXPECT_LT(worst, 1e-6);  // nodes and weights are rounded to floats
}

constexpr Extent extent{96, 64};

GaussianAirlight some(float extinction) {
  GaussianAirlight a;
  a.view = test_view(extent);
  a.gaussians = test_gaussians(40);
  a.lights = test_lights();
  a.lights.push_back({.vector = a.gaussians[0].center, .power = {1, 1, 1}});
  a.extinction = extinction;
  a.sky_distance = 60;
  return a;
}

bool contains(const GaussianPanels& p, GaussianPanels::Range r, std::uint32_t word) {
  return std::find(p.indices().begin() + r.begin, p.indices().begin() + r.end, word) != p.indices().begin() + r.end;
}

glm::dvec3 ray(const View& view, double x, double y) {
  const double w = view.extent.width, h = view.extent.height, t = static_cast<double>(view.tan_half_fov);
  return glm::normalize((2 * x / w - 1) * t * w / h * glm::dvec3(view.right) + (1 - 2 * y / h) * t * glm::dvec3(view.up) +
                        glm::dvec3(view.forward));
}

class Panels : public testing::TestWithParam<float> {};

TEST_P(Panels, MissNothing) {
  const GaussianAirlight a = some(GetParam());
  GaussianPanels panels(a);
  std::uint32_t next = 0;
  const auto number = [&](double from, double to) { return from + (to - from) * uniform(190, next++); };
  std::size_t met_at = 0, shaded = 0, without_end = 0;
  for (int y = 0; y < extent.height; y += bin_side) {
    for (int x = 0; x < extent.width; x += bin_side) {
      panels.make(x, y);
      float last = 0;
      std::set<std::uint32_t> active, passed;
      for (const GaussianPanels::Panel& p : panels.panels()) {
        ASSERT_LT(p.begin, p.end);
        ASSERT_GE(p.begin, last);
        last = p.end;
        for (std::uint32_t i = p.passed.begin; i < p.passed.end; ++i) {
          EXPECT_TRUE(active.contains(panels.indices()[i]));
          EXPECT_TRUE(passed.insert(panels.indices()[i]).second) << "passed twice";
        }
        for (std::uint32_t i = p.active.begin; i < p.active.end; ++i) {
          active.insert(panels.indices()[i]);
          EXPECT_FALSE(passed.contains(panels.indices()[i])) << "met again";
        }
        for (int sample = 0; sample < 4; ++sample) {
          const glm::dvec3 d = ray(a.view, number(x, x + bin_side), number(y, y + bin_side));
          const glm::dvec3 place = d * number(static_cast<double>(p.begin), static_cast<double>(p.end));
          for (std::uint32_t g = 0; g < a.gaussians.size(); ++g) {
            const double reach = static_cast<double>(a.gaussians[g].reach);
            const glm::dvec3 center(a.gaussians[g].center);
            if (glm::distance(center, place) < reach) {
              const auto met = std::find(panels.met().begin(), panels.met().end(), g);
              ASSERT_NE(met, panels.met().end());
              ASSERT_TRUE(contains(panels, p.active, static_cast<std::uint32_t>(met - panels.met().begin())));
              ++met_at;
            }
            for (std::size_t k = 0; k < a.lights.size(); ++k) {
              const Light& light = a.lights[k];
              const glm::dvec3 way = light.directional ? -glm::dvec3(light.vector) : glm::dvec3(light.vector) - place;
              const double length = light.directional ? 1e9 : glm::length(way);
              const glm::dvec3 toward = glm::normalize(way);
              const double foot = glm::dot(center - place, toward), nearest = std::clamp(foot, 0.0, length);
              if (glm::distance(place + nearest * toward, center) >= reach) continue;
              const GaussianPanels::Range list = panels.shades()[p.shades + k].shading;
              const bool to_infinity = contains(panels, list, g);
              ASSERT_TRUE(to_infinity || contains(panels, list, g | GaussianPanels::around_light)) << "light " << k;
              ++shaded;
              if (!to_infinity || light.directional) continue;
              // What lies behind the light must not count.
              EXPECT_TRUE(foot <= length && glm::distance(glm::dvec3(light.vector), center) >= reach);
              ++without_end;
            }
          }
        }
      }
    }
  }
  std::printf("met %zu times, shading %zu times, %zu of them as a way without end\n", met_at, shaded, without_end);
  EXPECT_GT(met_at, 1000U);
  EXPECT_GT(without_end, 1000U);
}

// Whether a Gaussian stands between a place and a light.
bool stands_before(const GaussianDensity& g, const Light& light, const glm::dvec3& place) {
  const glm::dvec3 way = light.directional ? -1e9 * glm::dvec3(light.vector) : glm::dvec3(light.vector) - place;
  const double along = std::clamp(glm::dot(glm::dvec3(g.center) - place, way) / glm::dot(way, way), 0.0, 1.0);
  return glm::distance(place + along * way, glm::dvec3(g.center)) < static_cast<double>(g.reach);
}

// With volumes no Gaussian is listed, and a panel which any of them may shade says so.
TEST_P(Panels, TellWhatVolumesShade) {
  GaussianAirlight a = some(GetParam());
  a.gaussians.resize(12);
  a.lights.push_back({.vector = {40, 1, -30}, .power = {1, 1, 1}});
  a.depths.resize(a.lights.size());
  GaussianPanels panels(a);
  std::uint32_t next = 0;
  const auto number = [&](double from, double to) { return from + (to - from) * uniform(191, next++); };
  std::size_t shaded = 0, open = 0;
  for (int y = 0; y < extent.height; y += bin_side) {
    for (int x = 0; x < extent.width; x += bin_side) {
      panels.make(x, y);
      for (const GaussianPanels::Panel& p : panels.panels()) {
        for (int sample = 0; sample < 8; ++sample) {
          const glm::dvec3 d = ray(a.view, number(x, x + bin_side), number(y, y + bin_side));
          const glm::dvec3 place = d * number(static_cast<double>(p.begin), static_cast<double>(p.end));
          for (std::size_t k = 0; k < a.lights.size(); ++k) {
            const GaussianPanels::Shade& shade = panels.shades()[p.shades + k];
            EXPECT_EQ(shade.shading.begin, shade.shading.end);
            const bool any = std::any_of(a.gaussians.begin(), a.gaussians.end(),
                                         [&](const GaussianDensity& g) { return stands_before(g, a.lights[k], place); });
            EXPECT_TRUE(shade.shaded || !any) << "light " << k;
            ++(shade.shaded ? shaded : open);
          }
        }
      }
    }
  }
  std::printf("places that may be shaded %zu, that cannot be %zu\n", shaded, open);
  EXPECT_GT(shaded, 1000U);
  if (GetParam() > 0) {
    EXPECT_GT(open, 1000U);
  }
}

// Every place in reach of a Gaussian lies in a panel, and with fog every place.
TEST_P(Panels, LeaveNoGap) {
  const GaussianAirlight a = some(GetParam());
  GaussianPanels panels(a);
  for (int y = 0; y < extent.height; y += bin_side) {
    panels.make(32, y);
    const glm::dvec3 d = ray(a.view, 40, y + 8);
    for (double t = 0.001; t < 60; t *= 1.01) {
      bool needed = a.extinction > 0;
      for (const GaussianDensity& g : a.gaussians)
        needed |= glm::distance(glm::dvec3(g.center), d * t) < static_cast<double>(g.reach);
      const bool there = std::any_of(panels.panels().begin(), panels.panels().end(), [&](const GaussianPanels::Panel& p) {
        return static_cast<double>(p.begin) <= t && t <= static_cast<double>(p.end);
      });
      EXPECT_TRUE(there || !needed) << t;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Extinction, Panels, testing::Values(0.0F, 0.05F),
                         [](const auto& p) { return p.param > 0 ? "in_fog" : "in_clear_air"; });

}  // namespace
}  // namespace airlight
