// No ray meets a Gaussian that its square's list has not, and lists are not much longer than that.
#include "common/plan/gaussian_bins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "common/plan/geometry.h"
#include "tests/parity/inputs.h"

namespace airlight {
namespace {

std::vector<GaussianDensity> around_the_camera(double middle, double half, double radius, unsigned count) {
  Scene scene;
  for (unsigned i = 0; i < count; ++i) {
    const auto number = [&](unsigned k) { return half * (2 * uniform(61, 4 * i + k) - 1); };
    scene.medium.gaussians.push_back({.center = {number(0), number(1), middle + number(2)},
                                      .radius = radius * (0.2 + uniform(61, 4 * i + 3)),
                                      .extinction = 1});
  }
  return gaussians_of(scene, {0, 0, 0});
}

// Samples lie up to half a pixel beside a pixel's centre.
bool meets(const View& view, const GaussianDensity& g, double column, double row) {
  const double w = view.extent.width, h = view.extent.height, t = static_cast<double>(view.tan_half_fov);
  const double x = (2 * column / w - 1) * t * w / h, y = (1 - 2 * row / h) * t;
  const glm::dvec3 d = glm::normalize(x * glm::dvec3(view.right) + y * glm::dvec3(view.up) + glm::dvec3(view.forward));
  const glm::dvec3 c(g.center);
  const double foot = std::max(0.0, glm::dot(d, c));
  return glm::length(c - foot * d) < static_cast<double>(g.reach);
}

void hold(const View& view, const std::vector<GaussianDensity>& gaussians, bool tight) {
  const std::vector<std::int32_t> bins = gaussian_bins(view, gaussians);
  const int columns = bin_columns(view.extent), rows = bin_rows(view.extent);
  std::size_t listed = 0, met = 0;
  for (int square = 0; square < columns * rows; ++square) {
    const auto* from = bins.data() + bins[static_cast<std::size_t>(square)];
    const auto* to = bins.data() + bins[static_cast<std::size_t>(square) + 1];
    EXPECT_TRUE(std::is_sorted(from, to));
    listed += static_cast<std::size_t>(to - from);
    for (std::size_t i = 0; i < gaussians.size(); ++i) {
      bool any = false;
      for (int k = 0; k < 25 && !any; ++k) {
        const double column = std::min<double>(square % columns * bin_side + k % 5 * bin_side / 4.0, view.extent.width);
        const double row = std::min<double>(square / columns * bin_side + k / 5 * bin_side / 4.0, view.extent.height);
        any = meets(view, gaussians[i], column, row);
      }
      if (!any) continue;
      ++met;
      EXPECT_TRUE(std::binary_search(from, to, static_cast<std::int32_t>(i))) << "square " << square << ", Gaussian " << i;
    }
  }
  std::printf("%zu Gaussians in %d squares: %zu met, %zu listed\n", gaussians.size(), columns * rows, met, listed);
  EXPECT_EQ(bins.size(), static_cast<std::size_t>(columns * rows + 1) + listed);
  if (tight) {
    EXPECT_LT(static_cast<double>(listed), 2.0 * static_cast<double>(met));
  }
}

TEST(GaussianBins, HoldWhatRaysMeet) {
  const View view = test_view({75, 50});
  hold(view, around_the_camera(-6, 4, 0.3, 120), true);
  hold(view, around_the_camera(0, 3, 0.3, 120), false);  // behind the camera, around it, beside it
  hold(view, around_the_camera(0, 0.5, 1, 30), false);
  hold(view, {}, false);
  View wide = view;
  wide.tan_half_fov = 20;
  hold(wide, around_the_camera(0, 3, 0.2, 120), false);
}

TEST(GaussianBins, WhatIsBehindIsInNone) {
  const View view = test_view({64, 48});
  const std::vector<GaussianDensity> behind = around_the_camera(9, 2, 0.3, 50);
  EXPECT_EQ(gaussian_bins(view, behind).size(), 4U * 3U + 1U);
}

}  // namespace
}  // namespace airlight
