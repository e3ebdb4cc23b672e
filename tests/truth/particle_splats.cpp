// What splats of particles leave: their optical depth beside the density that the particles were sampled from, and their image
// beside the reference's random paths, next to that of the source function from the same network.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/tolerances.h"
#include "tests/truth/network_error.h"

namespace airlight {
namespace {

RenderSettings splats(RenderSettings settings) {
  settings.knobs.emplace_back("image", "splats");
  return settings;
}

// Optical depths of 48 x 36 rays beside closed forms, and transmittances: relative RMSE and RMSE.
std::pair<double, double> depth_error(const Scene& scene, const std::string& particles) {
  RenderSettings settings;
  settings.technique = "illumination-network";
  settings.resolution = Extent{48, 36};
  settings.images = {"optical_depth", "transmittance"};
  settings.knobs = {{"particles", particles}, {"directions", "2"}, {"iterations", "1"}};
  Renderer renderer({.backend = "cpu"});
  const Frame frame = renderer.render(scene, splats(settings));
  const HostImage &depth = frame.image("optical_depth"), &through = frame.image("transmittance");
  const double tangent = std::tan(scene.camera.vertical_fov * 3.141592653589793 / 360);
  double squares = 0, mean = 0, squares_through = 0;
  constexpr double pixels = 48 * 36;
  for (int j = 0; j < 36; ++j) {
    for (int i = 0; i < 48; ++i) {
      const glm::dvec3 d((2 * (i + 0.5) / 48 - 1) * tangent * 4 / 3, (1 - 2 * (j + 0.5) / 36) * tangent, -1);
      const double truth = optical_depth(scene.medium.gaussians, scene.camera.position, glm::normalize(d), INFINITY);
      squares += std::pow(static_cast<double>(depth.at(i, j)) - truth, 2) / pixels, mean += truth / pixels;
      squares_through += std::pow(static_cast<double>(through.at(i, j)) - std::exp(-truth), 2) / pixels;
    }
  }
  return {std::sqrt(squares) / mean, std::sqrt(squares_through)};
}

TEST(ParticleSplatsTruth, OpticalDepthIsThatOfTheDensity) {
  const Scene scene = network_cloud(7.8, 0.9, 0);
  double first = 0, last = 0;
  for (const char* particles : {"64", "256", "1024", "4096", "16384"}) {
    const auto [error, through] = depth_error(scene, particles);
    std::printf("%s particles: optical depth %.2f %%, transmittance %.4f\n", particles, 100 * error, through);
    if (first == 0) first = error;
    last = error;
    if (particles == std::string("4096")) {
      EXPECT_FALSE(!(error <= tolerance("splats_depth")));
      EXPECT_FALSE(!(through <= tolerance("splats_transmittance")));
    }
  }
  // By n^(-1/3) it would be 6.3 times.
  EXPECT_LT(last, first / 5);
}

// A camera within the cloud sees half of it and less.
TEST(ParticleSplatsTruth, OpticalDepthFromWithin) {
  Scene scene = network_cloud(7.8, 0.9, 0);
  scene.camera.position = {0, 0, 0.3};
  scene.camera.look_at = {0, 0, -1};
  const auto [error, through] = depth_error(scene, "4096");
  std::printf("from within: optical depth %.2f %%, transmittance %.4f\n", 100 * error, through);
  EXPECT_FALSE(!(error <= tolerance("splats_depth_within")));
}

TEST(ParticleSplatsTruth, ImageBesideTheSourceFunction) {
  constexpr Extent extent{12, 9};
  for (const double g : {0.0, 0.6}) {
    const Scene scene = network_cloud(7.8, 0.9, g);
    const NetworkTruth truth = network_truth(scene, extent, 200);
    for (const NetworkSize& size : {NetworkSize{1024, 128, 32}, NetworkSize{4096, 128, 32}}) {
      if (g > 0 && size.particles != 1024) continue;
      const NetworkError a = network_error(scene, truth, size), b = network_error(scene, truth, size, "splats");
      std::printf(
          "g = %.1f, %d particles, %d directions: source function %.2f %% (mean %.3f), splats %.2f %% (mean %.3f); noise %.2f "
          "%%\n",
          g, size.particles, size.directions, 100 * a.error, a.mean, 100 * b.error, b.mean, 100 * truth.noise);
      if (size.particles == 1024) {
        EXPECT_FALSE(!(b.error <= tolerance(g > 0 ? "truth_splats_forward" : "truth_splats")));
      }
    }
  }
}

}  // namespace
}  // namespace airlight
