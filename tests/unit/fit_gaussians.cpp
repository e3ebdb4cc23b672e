// Fitting Gaussians to grids: what is known comes out again, slopes are slopes, threads change nothing.
#include "common/fit/fit_gaussians.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec4.hpp>
#include <thread>

#include "common/error.h"
#include "common/fit/depth_error.h"
#include "common/fit/descent.h"
#include "common/fit/placement.h"
#include "common/random.h"
#include "common/scene/grid_file.h"
#include "tests/tolerances.h"

namespace airlight {
namespace {

void forward(int n, const std::function<void(int)>& body) {
  for (int i = 0; i < n; ++i) body(i);
}
void backward(int n, const std::function<void(int)>& body) {
  for (int i = n - 1; i >= 0; --i) body(i);
}
void on_three_threads(int n, const std::function<void(int)>& body) {
  std::vector<std::jthread> threads;
  for (int t = 0; t < 3; ++t) {
    threads.emplace_back([=] {
      for (int i = t; i < n; i += 3) body(i);
    });
  }
}

// The sum of Gaussians of the world on the cells of a turned grid with unequal sides.
SparseGrid sampled(const std::vector<Gaussian>& gaussians) {
  SparseGrid grid;
  glm::dmat4 m = glm::translate(glm::dmat4(1), {100, -20, 7});
  m = glm::rotate(m, 0.7, glm::normalize(glm::dvec3(1, 2, -0.5)));
  m = glm::scale(m, {0.05, 0.07, 0.06});
  SparseGridBuilder builder("grid");
  for (int z = -20; z < 20; ++z) {
    for (int y = -20; y < 20; ++y) {
      for (int x = -20; x < 20; ++x) {
        const glm::dvec3 at(m * glm::dvec4(x, y, z, 1));
        double sum = 0;
        for (const Gaussian& g : gaussians)
          sum += g.extinction * std::exp(-glm::dot(at - g.center, at - g.center) / (g.radius * g.radius));
        if (sum > 1e-9) builder.set({x, y, z}, {x, y, z}, static_cast<float>(sum));
      }
    }
  }
  builder.finish(grid);
  grid.transform = m;
  return grid;
}

std::vector<Gaussian> three() {
  return {{{100, -20, 7}, 0.2, 3, {}, {}}, {{100.3, -20.1, 7.1}, 0.15, 5, {}, {}}, {{99.8, -19.8, 6.8}, 0.3, 1, {}, {}}};
}

TEST(FitGaussians, FindsThoseThatAGridIsMadeOf) {
  NoProgress none;
  const SparseGrid grid = sampled(three());
  const Fit fit = fit_gaussians(grid, "grid", {.count = 3, .steps = 300}, forward, none);
  ASSERT_EQ(fit.gaussians.size(), 3U);
  double worst = 0;
  for (const Gaussian& g : three()) {
    const Gaussian& found =
        *std::min_element(fit.gaussians.begin(), fit.gaussians.end(), [&](const Gaussian& a, const Gaussian& b) {
          return glm::length(a.center - g.center) < glm::length(b.center - g.center);
        });
    worst = std::max({worst, glm::length(found.center - g.center) / g.radius, std::abs(found.radius / g.radius - 1),
                      std::abs(found.extinction / g.extinction - 1)});
  }
  const GridFile dense = dense_grid(grid, "grid", none);
  GridMedium medium;
  medium.voxels = dense.voxels, medium.transform = dense.transform;
  const double depth = relative_depth_error(fit.gaussians, medium, 300), other = relative_depth_error({}, medium, 300);
  std::printf("largest error of a variable %.2e, density %.2e, depth %.2e (nothing: %.2e)\n", worst, fit.density_error, depth,
              other);
  EXPECT_LE(worst, tolerance("fit_known"));
  EXPECT_LE(fit.density_error, tolerance("fit_known"));
  EXPECT_LE(depth, tolerance("fit_depth_of_cells"));
  EXPECT_DOUBLE_EQ(other, 1);
}

// More Gaussians leave less, also of a density with many sizes and of few steps: one that has hardly anything to do must not hold
// the others.
TEST(FitGaussians, MoreOfThemLeaveLess) {
  std::vector<Gaussian> many(300);
  Random random({0x66697463U, 0}, 0);
  for (Gaussian& g : many) {
    for (int k = 0; k < 3; ++k) g.center[k] = glm::dvec3(100, -20, 7)[k] + 1.2 * (random.next() - 0.5);
    const double size = random.next();
    g.radius = 0.06 + 0.2 * size * size * size, g.extinction = 0.02 / (g.radius * g.radius);
  }
  const SparseGrid grid = sampled(many);
  NoProgress none;
  double before = 1;
  for (const int count : {200, 400, 800}) {
    const Fit fit = fit_gaussians(grid, "grid", {.count = count, .steps = 20}, forward, none);
    std::printf("%d Gaussians: density %.2f %% off\n", count, 100 * fit.density_error);
    EXPECT_LT(fit.density_error, before);
    before = fit.density_error;
  }
}

TEST(FitGaussians, SlopesAreThoseOfTheSquares) {
  const FitCells cells(sampled(three()), "grid");
  GaussianSum sum(cells, forward);
  std::vector<FitGaussian> g{{{1, 2, 3}, 0.25, 2}, {{-3, 4, 0}, 0.15, 4}};
  std::vector<FitSlopes> slopes, ignored;
  sum.half_squares(g, &slopes);
  double worst = 0;
  const auto check = [&](double told, double& variable, double step, double scale) {
    const double before = variable;
    variable = before + step;
    const double above = sum.half_squares(g, &ignored);
    variable = before - step;
    const double below = sum.half_squares(g, &ignored);
    variable = before;
    worst = std::max(worst, std::abs((above - below) / (2 * step) - told) / scale);
  };
  for (std::size_t i = 0; i < 2; ++i) {
    check(slopes[i].radius, g[i].radius, 1e-3, std::abs(slopes[i].radius));
    check(slopes[i].extinction, g[i].extinction, 1e-2, std::abs(slopes[i].extinction));
    const glm::dvec3 by_cells = glm::transpose(cells.axes()) * slopes[i].center;  // [1/cell]
    for (int k = 0; k < 3; ++k) check(by_cells[k], g[i].center[k], 1e-2, glm::length(by_cells));
  }
  std::printf("largest relative error of a slope %.2e\n", worst);
  EXPECT_LE(worst, tolerance("fit_slopes"));
}

TEST(FitGaussians, HasTheSameBitsWhateverRunsIt) {
  NoProgress none;
  const SparseGrid grid = sampled(three());
  const FitOptions options{.count = 40, .steps = 12};
  const Fit one = fit_gaussians(grid, "grid", options, forward, none);
  for (const EachIndex& each : {EachIndex(backward), EachIndex(on_three_threads)}) {
    const Fit other = fit_gaussians(grid, "grid", options, each, none);
    EXPECT_EQ(one.density_error, other.density_error);
    ASSERT_EQ(one.gaussians.size(), other.gaussians.size());
    for (std::size_t i = 0; i < one.gaussians.size(); ++i) {
      EXPECT_EQ(one.gaussians[i].center, other.gaussians[i].center);
      EXPECT_EQ(one.gaussians[i].radius, other.gaussians[i].radius);
      EXPECT_EQ(one.gaussians[i].extinction, other.gaussians[i].extinction);
      EXPECT_GT(one.gaussians[i].extinction, 0);
    }
  }
}

TEST(FitGaussians, RefusesAFlatGridAndStops) {
  class Stopping final : public Progress {
   public:
    void report(std::string_view, double) override {}
    bool stop_requested() const override { return true; }
  } stopping;
  SparseGrid grid = sampled(three());
  EXPECT_THROW(fit_gaussians(grid, "grid", {.count = 3, .steps = 3}, forward, stopping), Interrupted);
  grid.transform[2] = grid.transform[1];
  NoProgress none;
  EXPECT_THROW(fit_gaussians(grid, "grid", {.count = 3, .steps = 3}, forward, none), InputError);
}

}  // namespace
}  // namespace airlight
