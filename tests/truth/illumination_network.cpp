// Multiple scattering against the reference's random paths, whose noise is taken off. The whole table is airlight-network's.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/tolerances.h"
#include "tests/truth/network_error.h"

namespace airlight {
namespace {

constexpr Extent extent{12, 9};

NetworkError measured(const Scene& scene, const NetworkTruth& truth, const NetworkSize& size) {
  const NetworkError e = network_error(scene, truth, size);
  std::printf(
      "%d particles, %d directions: %.2f %% from paths known to %.2f %%, without their noise %.2f %%; mean %.4f of theirs\n",
      size.particles, size.directions, 100 * e.apart, 100 * truth.noise, 100 * e.error, e.mean);
  return e;
}

TEST(IlluminationNetworkTruth, Isotropic) {
  const Scene scene = network_cloud(7.8, 0.9, 0);
  const NetworkTruth truth = network_truth(scene, extent, 400);
  const NetworkError coarse = measured(scene, truth, {1024, 128, 32}), fine = measured(scene, truth, {4096, 256, 64});
  EXPECT_FALSE(!(fine.error <= tolerance("truth_network")));
  EXPECT_LT(fine.apart, coarse.apart);
}

TEST(IlluminationNetworkTruth, Forward) {
  const Scene scene = network_cloud(7.8, 0.9, 0.6);
  const NetworkError found = measured(scene, network_truth(scene, extent, 300), {1024, 128, 32});
  EXPECT_FALSE(!(std::fabs(found.mean - 1) <= tolerance("truth_network_forward")));
}

}  // namespace
}  // namespace airlight
