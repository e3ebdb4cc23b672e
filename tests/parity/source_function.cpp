#include "tests/parity/network.h"

namespace airlight {

namespace {

Case sources(const NetworkParts& parts, bool sky = false, Scene scene = test_gaussian_scene(6)) {
  Case c;
  if (sky) scene.environment = network_environment();
  const TestNetwork t = test_network(c, scene, network_lights(), parts);
  c.steps = {{t.network, ""}, {t.light, ""}, {t.iteration, ""}, {t.source, ""}};
  c.results = {{"sources", t.source.sources}};
  return c;
}

const NamedCase cases[] = {
    {"source_function/isotropic", [](Extent) { return sources({.iterations = 8}); }},
    {"source_function/sky", [](Extent) { return sources({.iterations = 8}, true); }},
    {"source_function/forward",
     [](Extent) {
       return sources({.lines = 6, .phase = {PhaseKind::cornette_shanks, 0.5}, .iterations = 8});
     }},
    {"source_function/bricks", [](Extent) { return sources({.iterations = 8, .sparse = true}, false, far_gaussians()); }},
};

}  // namespace

std::span<const NamedCase> source_function_cases() { return cases; }

}  // namespace airlight
