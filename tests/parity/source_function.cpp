#include "tests/parity/network.h"

namespace airlight {

namespace {

Case sources(const NetworkParts& parts, bool sky = false) {
  Case c;
  Scene scene = test_gaussian_scene(6);
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
};

}  // namespace

std::span<const NamedCase> source_function_cases() { return cases; }

}  // namespace airlight
