// The baseline marches toward the truth.
#include "bench/brute_force.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "common/reference/reference.h"
#include "tests/parity/inputs.h"
#include "tests/tolerances.h"
#include "tests/truth/relative_error.h"

namespace airlight {
namespace {

constexpr Extent extent{80, 60};

// The torus and its shadows under a lamp out of view and the moon.
Scene scene() {
  Scene s = test_scene(2000);
  s.lights[0].position = {-3, 4, 1};
  s.lights.erase(s.lights.begin() + 1);
  s.sky_distance = 30;
  return s;
}

TEST(BruteForce, ConvergesToTheTruth) {
  const Scene s = scene();
  NoProgress progress;
  const ReferenceFrame truth = reference_frame(s, extent, {1e-6, true, Indirect::off}, true, 2, progress);
  const BruteForce brute(s, 2);
  std::vector<double> errors;
  for (const int steps : {8, 32, 128, 512}) {
    errors.push_back(relative_error(brute.render(extent, steps), truth, parts[0]).off_edges);
    std::printf("%d steps: relative RMSE %.4f %%\n", steps, 100 * errors.back());
  }
  EXPECT_FALSE(!(errors[3] < tolerance("brute_force")));
  EXPECT_LT(errors[1], errors[0]);
  EXPECT_LT(errors[3], errors[1] / 4);
}

TEST(BruteForce, RefusesWhatIsNotHomogeneous) {
  Scene s = scene();
  s.medium.gaussians.emplace_back();
  EXPECT_THROW(BruteForce(s, 1), InputError);
}

}  // namespace
}  // namespace airlight
