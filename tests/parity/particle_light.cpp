#include "tests/parity/network.h"

namespace airlight {

namespace {

Case light(int gaussians, bool grid, const std::vector<LightSource>& lights, const NetworkParts& parts) {
  Case c;
  Scene scene = test_gaussian_scene(gaussians);
  if (grid) scene.medium.grid = test_grid();
  const TestNetwork t = test_network(c, scene, lights, parts);
  c.steps = {{t.light, ""}};
  c.results = {{"first", t.light.first}};
  return c;
}

const NamedCase cases[] = {
    {"particle_light/isotropic", [](Extent) { return light(7, false, network_lights(), {}); }},
    {"particle_light/forward",
     [](Extent) {
       return light(7, false, network_lights(), {.lines = 5, .phase = {PhaseKind::henyey_greenstein, 0.6}});
     }},
    {"particle_light/grid", [](Extent) { return light(2, true, network_lights(), {}); }},
    {"particle_light/glow_alone", [](Extent) { return light(3, false, {}, {}); }},
};

}  // namespace

std::span<const NamedCase> particle_light_cases() { return cases; }

}  // namespace airlight
