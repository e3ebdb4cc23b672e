// When the rounds of an illumination network end: where little enough is left out, whatever the phase function and the albedo.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "common/techniques/technique.h"
#include "tests/tolerances.h"
#include "tests/unit/network_ran.h"

namespace airlight {

namespace {

float standard_tolerance() {
  for (const Knob& knob : technique("illumination-network").knobs) {
    if (knob.name == "tolerance") return std::stof(std::string(knob.standard));
  }
  return 0;
}

// A cloud of this depth along its thickest line, about, with a lamp in its middle or above it.
Scene cloud(double depth, double albedo) {
  Scene scene = two_gaussians(albedo);
  for (Gaussian& g : scene.medium.gaussians) g.extinction *= depth / 5;
  return scene;
}

double sum(const std::vector<float>& sources) {
  double all = 0;
  for (const float one : sources) all += static_cast<double>(one);
  return all;
}

TEST(NetworkRounds, EndWhereAsMuchIsLeftOutAsTheyTell) {
  const float asked = standard_tolerance();
  double most = 0, least = 2;
  for (const double g : {-0.8, 0.0, 0.6, 0.9}) {
    const Phase phase = g == 0 ? Phase{} : Phase{PhaseKind::henyey_greenstein, g};
    for (const double albedo : {0.5, 0.9, 1.0}) {
      for (const double depth : {2.0, 20.0}) {
        for (const std::size_t light : {0U, 1U}) {
          std::vector<LightSource> lights{network_lights()[light]};
          if (light == 0) lights[0].position = {-0.4, 0, 0.1};
          NetworkParts parts{
              .particles = 200, .lines = g == 0 ? 16 : 24, .window = 5, .phase = phase, .tolerance = asked, .iterations = 5000};
          const RanNetwork ended(cloud(depth, albedo), lights, parts);
          parts.tolerance = 0;
          parts.iterations = std::min(4 * static_cast<int>(ended.residuals[0]) + 40, 5000);
          const RanNetwork all(cloud(depth, albedo), lights, parts);
          const double left_out = 1 - sum(ended.sources) / sum(all.sources);
          const StepStats& stats = ended.stats.steps[2];
          EXPECT_TRUE(stats.converged);
          EXPECT_EQ(stats.residuals.size(), static_cast<std::size_t>(ended.residuals[0]));
          const auto told = static_cast<double>(stats.left_out);
          EXPECT_LE(told, static_cast<double>(asked));
          EXPECT_LE(left_out, (1 + tolerance("network_left_out")) * static_cast<double>(asked));
          EXPECT_LE(std::fabs(left_out / told - 1), tolerance("network_left_out"))
              << "g " << g << ", albedo " << albedo << ", depth " << depth;
          most = std::max(most, left_out / told);
          least = std::min(least, left_out / told);
          std::printf("g %4.1f, albedo %.1f, depth %4.1f, %s: %3zu rounds, %.2e left out, told %.2e\n", g, albedo, depth,
                      light == 0 ? "lamp" : "sun ", stats.residuals.size(), left_out, told);
        }
      }
    }
  }
  std::printf("asked for %g: between %.3f and %.3f of what is told are left out\n", static_cast<double>(asked), least, most);
}

TEST(NetworkRounds, TellWhereTheyWereNotEnough) {
  const RanNetwork ran(cloud(20, 1), network_lights(), {.particles = 200, .lines = 16, .window = 5, .iterations = 4});
  const StepStats& stats = ran.stats.steps[2];
  EXPECT_EQ(stats.residuals.size(), 4U);
  EXPECT_FALSE(stats.converged);
  EXPECT_GT(stats.left_out, 0.05F);
}

// Conjugate gradients take no more rounds to the same light but where two do, and tell no less than they leave out: no error of
// one particle makes up for that of another.
TEST(NetworkRounds, OfGradientsEndWhereNoMoreIsLeftOutThanTheyTell) {
  const float asked = standard_tolerance();
  double most = 0;
  for (const double albedo : {0.3, 0.9, 0.99, 1.0}) {
    for (const double depth : {0.5, 2.0, 20.0, 60.0}) {
      for (const std::size_t light : {0U, 1U}) {
        std::vector<LightSource> lights{network_lights()[light]};
        if (light == 0) lights[0].position = {-0.4, 0, 0.1};
        NetworkParts parts{.particles = 200, .lines = 16, .window = 5, .tolerance = asked, .iterations = 1000};
        const RanNetwork plain(cloud(depth, albedo), lights, parts);
        parts.gradients = true;
        const RanNetwork ended(cloud(depth, albedo), lights, parts);
        parts.tolerance = 1e-6F;
        const RanNetwork all(cloud(depth, albedo), lights, parts);
        double off = 0;
        for (std::size_t k = 0; k < all.sources.size(); ++k) {
          off += std::fabs(static_cast<double>(all.sources[k]) - static_cast<double>(ended.sources[k]));
          EXPECT_GE(ended.sources[k], ended.first[k]);
        }
        off /= sum(all.sources);
        const StepStats& stats = ended.stats.steps[2];
        const auto told = static_cast<double>(stats.left_out);
        EXPECT_TRUE(stats.converged);
        EXPECT_LE(told, static_cast<double>(asked));
        EXPECT_LE(off, (1 + tolerance("network_left_out")) * told) << "albedo " << albedo << ", depth " << depth;
        EXPECT_LE(ended.residuals[0], std::max(plain.residuals[0], 2.0F));
        most = std::max(most, off / told);
        std::printf("albedo %.2f, depth %4.1f, %s: %2g rounds, plain %3g, %.2e off, told %.2e\n", albedo, depth,
                    light == 0 ? "lamp" : "sun ", static_cast<double>(ended.residuals[0]),
                    static_cast<double>(plain.residuals[0]), off, told);
      }
    }
  }
  std::printf("asked for %g: at most %.3f of what is told are left out\n", static_cast<double>(asked), most);
}

// A history by itself: rounds of a geometric series, and what cannot be told yet.
TEST(NetworkRounds, TheRestOfAGeometricSeries) {
  std::vector<float> history;
  double all = 1, change = 1;
  for (int k = 0; k < 20; ++k) {
    change *= 0.8, all += change;
    history.push_back(static_cast<float>(change / all));
    EXPECT_NEAR(static_cast<double>(NetworkIteration::left_out(history)), (5 - all) / all, 1e-5) << k;
  }
  EXPECT_GT(NetworkIteration::left_out({}), 0.99F);
  const std::vector<float> all_new{1}, nothing{0.5F, 0};
  EXPECT_GT(NetworkIteration::left_out(all_new), 1e3F);
  EXPECT_EQ(NetworkIteration::left_out(nothing), 0);
}

}  // namespace

}  // namespace airlight
