// Multiple scattering against the reference's random paths, whose noise is taken off. The whole table is airlight-network's.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "tests/tolerances.h"
#include "tests/truth/network_error.h"

namespace airlight {
namespace {

constexpr Extent extent{12, 9};

NetworkError measured(const Scene& scene, const NetworkTruth& truth, const NetworkSize& size) {
  const NetworkError e = network_error(scene, truth, size);
  const std::string name = size.particles > 0
                               ? std::to_string(size.particles) + " particles, " + std::to_string(size.directions) + " directions"
                               : "default knobs";
  std::printf("%s: %.2f %% from paths known to %.2f %%, without their noise %.2f %%; mean %.4f of theirs\n", name.c_str(),
              100 * e.apart, 100 * truth.noise, 100 * e.error, e.mean);
  return e;
}

// What is promised up to an optical depth of 10.
TEST(IlluminationNetworkTruth, Isotropic) {
  const Scene scene = network_cloud(10, 0.9, 0);
  const NetworkTruth truth = network_truth(scene, extent, 400);
  const NetworkError coarse = measured(scene, truth, {1024, 128, 32}), fine = measured(scene, truth, {});
  EXPECT_FALSE(!(fine.error <= tolerance("truth_network")));
  EXPECT_LT(fine.apart, coarse.apart);
}

TEST(IlluminationNetworkTruth, Forward) {
  const Scene scene = network_cloud(7.8, 0.9, 0.6);
  const NetworkError found = measured(scene, network_truth(scene, extent, 300), {1024, 128, 32});
  EXPECT_FALSE(!(std::fabs(found.mean - 1) <= tolerance("truth_network_forward")));
}

// Particles have the albedo and the glow of the Gaussians about them: one of these takes all light, one scatters all, one glows.
TEST(IlluminationNetworkTruth, UnlikeGaussians) {
  Scene scene = network_cloud(6, 1, 0);
  const double albedos[] = {0.95, 1, 0, 0.5, 0.99};
  for (std::size_t k = 0; k < 5; ++k) scene.medium.gaussians[k].albedo = glm::dvec3(albedos[k]);
  for (const double glow : {0.0, 0.5}) {
    scene.medium.gaussians[3].emission = glm::dvec3(glow);
    const NetworkError found = measured(scene, network_truth(scene, extent, 400), {});
    EXPECT_FALSE(!(found.error <= tolerance("truth_network"))) << glow;
  }
}

// Neither lines nor nodes are spread over what is empty between small clouds.
TEST(IlluminationNetworkTruth, SmallCloudsFarApart) {
  for (const glm::dvec3& apart : {glm::dvec3(10, 0, 0), glm::dvec3(6, -6, -6)}) {
    const Scene scene = small_clouds(apart);
    const NetworkError found = measured(scene, network_truth(scene, {8, 6}, 800), {});
    EXPECT_FALSE(!(found.error <= tolerance("truth_network_far")));
  }
}

// A bright sky above dim ground lights it, and is seen through it.
TEST(IlluminationNetworkTruth, Sky) {
  Scene scene = network_cloud(4, 0.9, 0.3);
  scene.lights.clear();
  auto image = std::make_shared<HostImage>(Extent{8, 4}, 3);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      for (int c = 0; c < 3; ++c) image->at(x, y, c) = y < 2 ? 1 + 0.5F * static_cast<float>(x % 4) : 0.2F;
    }
  }
  scene.environment = Environment{image, {1, 1, 1}, 40};
  const NetworkError found = measured(scene, network_truth(scene, extent, 500), {});
  EXPECT_FALSE(!(found.error <= tolerance("truth_network_sky")));
}

}  // namespace
}  // namespace airlight
