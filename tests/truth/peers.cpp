// The reference against images of exact single scattering made elsewhere (scenes/peers, tests/data/peers: 160x120, one channel,
// little-endian PFM).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "common/reference/reference.h"
#include "common/scene/image_file.h"
#include "common/scene/load.h"

namespace airlight {
namespace {

constexpr Extent extent{160, 120};

void compare(const std::string& name) {
  const Scene scene = load_scene(AIRLIGHT_SCENES "/peers/" + name + ".json");
  const HostImage image = read_image(AIRLIGHT_TEST_DATA "/peers/" + name + ".pfm");
  ASSERT_EQ(image.extent, extent);
  ASSERT_EQ(image.channels, 1);
  const std::vector<double> truth(image.values.begin(), image.values.end());
  NoProgress progress;
  const int threads = static_cast<int>(std::thread::hardware_concurrency());
  const ReferenceFrame frame = reference_frame(scene, extent, {}, false, threads, progress);
  double squares = 0, mean = 0, worst = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double value = frame.pixels[i].beauty().x;
    ASSERT_TRUE(std::isfinite(value));
    squares += (value - truth[i]) * (value - truth[i]);
    mean += truth[i];
    worst = std::max(worst, std::fabs(value - truth[i]) / truth[i]);
  }
  const double n = static_cast<double>(truth.size());
  const double rmse = std::sqrt(squares / n) / (mean / n);
  std::printf("%s: relative RMSE %.3g, worst pixel %.3g, claimed %.2g\n", name.c_str(), rmse, worst, frame.error);
  EXPECT_FALSE(!(rmse < 1e-5));
  EXPECT_FALSE(!(frame.error <= 1e-6));
}

TEST(Peers, FogWithLampInView) { compare("S1"); }
TEST(Peers, Blob) { compare("S2"); }
TEST(Peers, ShaftsBehindBox) { compare("S4"); }

}  // namespace
}  // namespace airlight
