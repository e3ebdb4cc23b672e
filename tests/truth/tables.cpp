// The reference against tables of high-precision values.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>

#include "app/airlight.h"
#include "common/reference/reference.h"
#include "tests/csv.h"
#include "tests/tolerances.h"
#include "tests/truth/optical_depth_table.h"
#include "tests/truth/scenes.h"

namespace airlight {
namespace {

double relative_error(double value, double expected) { return std::fabs(value - expected) / std::fabs(expected); }

TEST(Tables, OpticalDepth) {
  double worst = 0;
  for (const WayThroughGaussians& way : optical_depth_table()) {
    const double expected = way.optical_depth;
    const double value = optical_depth(way.gaussians, way.from, way.to);
    if (expected < 1e-30) {
      EXPECT_FALSE(!(std::fabs(value - expected) <= 1e-30));
      continue;
    }
    const double error = relative_error(value, expected);
    EXPECT_FALSE(!(error <= 1e-11)) << value << " instead of " << expected;
    worst = std::max(worst, error);
  }
  std::printf("optical_depth.csv: largest relative error %.2g\n", worst);
}

// What the program shows of the same ways: a picture of one pixel whose ray ends where the way does.
TEST(Tables, OpticalDepthRendered) {
  for (const char* backend : {"cpu", "gl"}) {
    Renderer renderer({.backend = backend});
    double worst = 0;
    int rows = 0;
    for (const auto& [from, to, gaussians, expected] : optical_depth_table()) {
      Scene scene;
      scene.camera = {.position = from, .look_at = to, .vertical_fov = 1, .resolution = {1, 1}};
      if (std::fabs(glm::normalize(to - from).y) > 0.99) scene.camera.up = {1, 0, 0};
      scene.sky_distance = glm::distance(from, to);
      scene.medium.gaussians = gaussians;
      RenderSettings settings;
      settings.technique = "gaussian-airlight";
      settings.knobs = {{"lost_depth", "1e-5"}};
      settings.images = {"optical_depth"};
      const double value = static_cast<double>(renderer.render(scene, settings).image("optical_depth").at(0, 0));
      const double error = std::fabs(value - expected) / lines_through_centers(gaussians);
      EXPECT_FALSE(!(error < tolerance("rendered_optical_depth"))) << backend << ": " << value << " instead of " << expected;
      worst = std::max(worst, error);
      ++rows;
    }
    std::printf("optical_depth.csv by gaussian-airlight on %s: %d rows, largest error %.2g of the lines through the centres\n",
                backend, rows, worst);
    EXPECT_GT(rows, 100);
  }
}

TEST(Tables, GaussianLineIntegral) {
  double worst = 0;
  for (const auto& row : csv_rows("reference/gaussian_line_integral.csv")) {
    ASSERT_EQ(row.size(), 6U);
    const double a = std::stod(row[0]), c = std::stod(row[1]), h = std::stod(row[2]), t_center = std::stod(row[3]),
                 d = std::stod(row[4]), expected = std::strtod(row[5].c_str(), nullptr);
    const double value = gaussian_line_integral(a, c, h, t_center, 0, d);
    if (expected < 1e-30) {
      EXPECT_FALSE(!(std::fabs(value - expected) <= 1e-30));
      continue;
    }
    const double error = relative_error(value, expected);
    EXPECT_FALSE(!(error <= 1e-11)) << a << ' ' << h << ' ' << d << ": " << value << " instead of " << expected;
    worst = std::max(worst, error);
  }
  std::printf("gaussian_line_integral.csv: largest relative error %.2g\n", worst);
}

// The table's light has no radius: here one that clamps nothing.
TEST(Tables, AirlightHomogeneous) {
  const std::map<std::string, Phase> phases{
      {"isotropic", {}},
      {"rayleigh", {PhaseKind::rayleigh, 0}},
      {"hg0.6", {PhaseKind::henyey_greenstein, 0.6}},
      {"cs0.6", {PhaseKind::cornette_shanks, 0.6}},
      {"mie_hazy", {PhaseKind::mie_hazy, 0}},
      {"mie_murky", {PhaseKind::mie_murky, 0}},
  };
  double worst = 0, most_claimed = 0;
  int compared = 0;
  for (const auto& row : csv_rows("reference/airlight_homogeneous.csv")) {
    ASSERT_EQ(row.size(), 6U);
    const double k = std::stod(row[1]), l = std::stod(row[2]), phi = std::stod(row[3]), d = std::stod(row[4]);
    const double expected = std::strtod(row[5].c_str(), nullptr);
    Scene scene = foggy_scene(k);
    scene.sky_distance = d;
    scene.medium.phase = phases.at(row[0]);
    scene.lights = {point_light({l * std::sin(phi), 0, -l * std::cos(phi)}, glm::dvec3(1), 1e-12)};
    const ReferencePixel p = Reference(scene, {1e-9, true}).pixel(centre, one_pixel);
    if (expected < 1e-30) {
      EXPECT_FALSE(!(std::fabs(p.airlight.x - expected) <= 1e-30));
      continue;
    }
    ++compared;
    const double error = relative_error(p.airlight.x, expected);
    EXPECT_FALSE(!(error <= 1e-8)) << row[0] << " k " << k << " l " << l << " phi " << phi << " d " << d << ": " << p.airlight.x
                                   << " instead of " << expected;
    worst = std::max(worst, error);
    most_claimed = std::max(most_claimed, p.error);
  }
  std::printf("airlight_homogeneous.csv: %d rows above 1e-30, largest relative error %.2g, largest claimed %.2g\n", compared,
              worst, most_claimed);
  EXPECT_GT(compared, 200);
}

}  // namespace
}  // namespace airlight
