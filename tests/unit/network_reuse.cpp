// What of a frame of illumination-network is made again: only what changed, with the same bits as a cold render; and what it
// refuses.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

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

// What the plan says of its rounds: conjugate gradients where the phase function is isotropic, unless they are off.
TEST(NetworkReuse, ExplainTellsWhyLightGoesRoundAsItDoes) {
  Scene scene = two_gaussians(0.8);
  scene.lights = network_lights();
  RenderSettings settings;
  settings.technique = "illumination-network";
  const auto tells = [&](std::string_view what) { return explain(scene, settings).find(what) != std::string::npos; };
  EXPECT_TRUE(tells("by conjugate gradients: the phase function is isotropic"));
  settings.knobs = {{"acceleration", "off"}};
  EXPECT_FALSE(tells("gradients:"));
  EXPECT_TRUE(tells("an order of scattering a round (")) << explain(scene, settings);
  settings.knobs.clear();
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.3};
  EXPECT_TRUE(tells("an order of scattering a round: the phase function depends on the direction"));
}

// Nodes stand in bricks about small clouds, if there may be enough of them.
TEST(NetworkReuse, ExplainTellsWhereNodesMissTheMedium) {
  Scene scene = two_gaussians(0.8);
  scene.lights = network_lights();
  RenderSettings settings;
  settings.technique = "illumination-network";
  const auto tells = [&](std::string_view what) { return explain(scene, settings).find(what) != std::string::npos; };
  EXPECT_TRUE(tells("toward the camera, everywhere"));
  for (Gaussian& g : scene.medium.gaussians) g.radius *= 0.2, g.center = glm::dvec3(10 * g.center.x);
  EXPECT_TRUE(tells("in bricks where any of the medium is")) << explain(scene, settings);
  settings.knobs = {{"resolution", "6"}};
  EXPECT_TRUE(tells("nodes miss most of what is narrower")) << explain(scene, settings);
}

TEST(IlluminationNetwork, RefusesWhatHasNoParticles) {
  Scene fog;
  fog.medium.extinction = 0.1;
  const auto why = technique("illumination-network").refuses(fog);
  ASSERT_TRUE(why);
  EXPECT_NE(why->find("neither"), std::string::npos) << *why;
}

// What does not fit is told before a step runs, in a line that names it.
template <class Error>
void refuses_size(const std::string& backend, const std::string& directions, const Phase& phase, const std::string& message) {
  Scene scene = two_gaussians(0.8);
  scene.medium.phase = phase;
  RenderSettings settings;
  settings.technique = "illumination-network";
  settings.knobs = {{"particles", "100000"}, {"directions", directions}};
  try {
    Renderer({.backend = backend, .gl_context = "osmesa"}).render(scene, settings);
    ADD_FAILURE() << "it rendered";
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).substr(0, message.size()), message);
  }
}

TEST(IlluminationNetwork, RefusesWhatIsTooLarge) {
  refuses_size<InputError>("cpu", "1024", {PhaseKind::henyey_greenstein, 0.5},
                           "setting particles: the network of 100000 particles and 1024 directions would take 4140 MiB, ");
  refuses_size<MachineError>("gl", "256", {}, "visibility_network: takes a buffer of 253 MiB, ");
}

}  // namespace

}  // namespace airlight
