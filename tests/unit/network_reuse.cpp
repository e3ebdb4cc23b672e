// What of a frame of illumination-network is made again: only what changed, with the same bits as a cold render; and what it
// refuses.
#include <gtest/gtest.h>

#include <string>

#include "app/airlight.h"
#include "common/techniques/technique.h"
#include "tests/parity/network.h"

namespace airlight {

namespace {

// Of a warm frame only what changed is made again: the camera moves, the lights change, then the medium.
TEST(NetworkReuse, OnlyWhatChangedIsMadeAgain) {
  Scene scene = two_gaussians(0.8);
  scene.camera.resolution = {24, 18};
  scene.lights = network_lights();
  RenderSettings settings;
  settings.technique = "illumination-network";
  settings.knobs = {{"particles", "200"}, {"directions", "20"}, {"resolution", "8"}, {"steps", "8"}};
  Renderer warm({.backend = "cpu"});
  const auto ran = [&] {
    const Frame frame = warm.render(scene, settings);
    Renderer cold({.backend = "cpu"});
    EXPECT_EQ(frame.image("beauty").values, cold.render(scene, settings).image("beauty").values);
    std::string names;
    for (const StepStats& step : frame.stats.steps) {
      const bool of_network = step.name == "visibility_network" || step.name == "particle_light" ||
                              step.name == "network_iteration" || step.name == "source_function";
      if (of_network && !step.reused) names += step.name + " ";
      if (step.name != "network_iteration") continue;
      EXPECT_EQ(step.residuals.empty(), step.reused);
      if (!step.residuals.empty()) {
        EXPECT_TRUE(step.converged);
        EXPECT_LE(step.left_out, 1e-3F);
      }
    }
    return names;
  };
  EXPECT_EQ(ran(), "visibility_network particle_light network_iteration source_function ");
  scene.camera.position.z += 0.5;
  EXPECT_EQ(ran(), "");
  scene.lights[0].power *= 2;
  EXPECT_EQ(ran(), "particle_light network_iteration source_function ");
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.3};
  EXPECT_EQ(ran(), "particle_light network_iteration source_function ");
  scene.camera.position.x += 0.5;
  EXPECT_EQ(ran(), "source_function ");
  scene.medium.gaussians[1].extinction *= 2;
  EXPECT_EQ(ran(), "visibility_network particle_light network_iteration source_function ");
}

TEST(IlluminationNetwork, RefusesWhatHasNoParticles) {
  Scene fog;
  fog.medium.extinction = 0.1;
  const auto why = technique("illumination-network").refuses(fog);
  ASSERT_TRUE(why);
  EXPECT_NE(why->find("neither"), std::string::npos) << *why;
}

}  // namespace

}  // namespace airlight
