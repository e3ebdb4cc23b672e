// gaussian-airlight against the reference: by default, and how its error falls with the nodes.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <thread>

#include "app/airlight.h"
#include "common/reference/reference.h"
#include "common/relative_rmse.h"
#include "tests/tolerances.h"
#include "tests/truth/gaussian_scenes.h"

namespace airlight {
namespace {

// The truth's time grows with the square of the number of Gaussians.
Extent extent_for(const Scene& scene) {
  const std::size_t n = scene.medium.gaussians.size();
  return n > 1000 ? Extent{8, 6} : n > 100 ? Extent{24, 18} : Extent{64, 48};
}

double off_edges(const HostImage& image, const ReferenceFrame& truth, bool airlight_alone) {
  RelativeRmse error;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    if (truth.edges[i]) continue;
    const glm::dvec3 expected = airlight_alone ? truth.pixels[i].airlight : truth.pixels[i].beauty();
    for (int c = 0; c < 3; ++c) error.add(static_cast<double>(image.values[3 * i + static_cast<std::size_t>(c)]), expected[c]);
  }
  return error.value();
}

class GaussianTruth : public testing::TestWithParam<TruthScene> {};

TEST_P(GaussianTruth, ErrorFallsWithTheNodes) {
  const Scene scene = GetParam().make();
  const Extent extent = extent_for(scene);
  NoProgress progress;
  const int threads = static_cast<int>(std::thread::hardware_concurrency());
  const ReferenceFrame truth = reference_frame(scene, extent, {1e-5, true, true}, true, threads, progress);
  std::printf("%zu Gaussians, %dx%d, truth claims %.1e\n", scene.medium.gaussians.size(), extent.width, extent.height,
              truth.error);
  EXPECT_FALSE(!(truth.error <= 1e-4));
  for (const char* backend : {"cpu", "gl"}) {
    Renderer renderer({.backend = backend});
    for (const char* samples : {"1", "2", "3", "4", "6", "8"}) {
      const std::string name = samples;
      if (backend == std::string("gl") && name != "4") continue;
      RenderSettings settings;
      settings.technique = "gaussian-airlight";
      settings.knobs = {{"samples", name}};
      settings.resolution = extent;
      settings.images = {"beauty", "airlight"};
      const Frame frame = renderer.render(scene, settings);
      const double beauty = off_edges(frame.image("beauty"), truth, false);
      const double airlight = off_edges(frame.image("airlight"), truth, true);
      std::printf("%-3s samples %s: relative RMSE %.5f %%, of the airlight alone %.5f %%\n", backend, samples, 100 * beauty,
                  100 * airlight);
      if (name == "4") {
        EXPECT_FALSE(!(airlight < tolerance("truth_gaussians"))) << backend;
        EXPECT_FALSE(!(beauty < tolerance("truth_gaussians"))) << backend;
      } else if (name == "8") {
        EXPECT_FALSE(!(airlight < tolerance("truth_gaussians_fine"))) << backend;
        EXPECT_FALSE(!(beauty < tolerance("truth_gaussians_fine"))) << backend;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Truth, GaussianTruth, testing::ValuesIn(gaussian_scenes().begin(), gaussian_scenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace airlight
