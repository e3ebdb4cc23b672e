#include "tests/parity/network.h"

namespace airlight {

namespace {

Case iterate(int gaussians, const NetworkParts& parts, bool sky = false) {
  Case c;
  Scene scene = test_gaussian_scene(gaussians);
  if (sky) scene.environment = network_environment();
  const TestNetwork t = test_network(c, scene, network_lights(), parts);
  c.steps = {{t.network, ""}, {t.light, ""}, {t.iteration, ""}};
  c.results = {{"sources", t.iteration.sources}};
  return c;
}

const NamedCase cases[] = {
    {"network_iteration/isotropic", [](Extent) { return iterate(7, {}); }},
    {"network_iteration/without_fog", [](Extent) { return iterate(7, {.lines = 40, .extinction = 0}); }},
    {"network_iteration/forward",
     [](Extent) {
       return iterate(7, {.lines = 8, .phase = {PhaseKind::henyey_greenstein, 0.6}, .iterations = 40});
     }},
    {"network_iteration/even",
     [](Extent) {
       return iterate(7, {.particles = 333, .lines = 9, .phase = {PhaseKind::rayleigh, 0}, .iterations = 40});
     }},
    {"network_iteration/sky", [](Extent) { return iterate(7, {}, true); }},
    {"network_iteration/sky_forward",
     [](Extent) {
       return iterate(7, {.lines = 8, .phase = {PhaseKind::henyey_greenstein, 0.6}, .iterations = 40}, true);
     }},
    {"network_iteration/gradients", [](Extent) { return iterate(7, {.gradients = true}); }},
    {"network_iteration/gradients_sky", [](Extent) { return iterate(7, {.extinction = 0, .gradients = true}, true); }},
    {"network_iteration/gradients_few",
     [](Extent) { return iterate(7, {.particles = 333, .lines = 9, .tolerance = 0, .iterations = 3, .gradients = true}); }},
    {"network_iteration/particle_each_gaussian",
     [](Extent) { return iterate(60, {.lines = 9, .window = 4, .iterations = 40, .particle_set = ParticleSet::gaussians}); }},
    {"network_iteration/gradients_one_particle",
     [](Extent) { return iterate(2, {.particles = 1, .lines = 1, .window = 1, .gradients = true}); }},
    {"network_iteration/first_order", [](Extent) { return iterate(5, {.iterations = 1}); }},
    {"network_iteration/one_particle", [](Extent) { return iterate(2, {.particles = 1, .lines = 1, .window = 1}); }},
};

}  // namespace

std::span<const NamedCase> network_iteration_cases() { return cases; }

}  // namespace airlight
