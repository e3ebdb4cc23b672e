#include "tests/parity/network.h"

namespace airlight {

namespace {

Case links(int gaussians, bool grid, const NetworkParts& parts) {
  Case c;
  Scene scene = test_gaussian_scene(gaussians);
  if (grid) scene.medium.grid = test_grid();
  const TestNetwork t = test_network(c, scene, {}, parts);
  c.steps = {{t.network, ""}};
  c.results = {{"links", t.network.links}};
  return c;
}

const NamedCase cases[] = {
    {"visibility_network/gaussians", [](Extent) { return links(7, false, {}); }},
    {"visibility_network/many_gaussians", [](Extent) { return links(150, false, {.lines = 3}); }},
    {"visibility_network/grid", [](Extent) { return links(2, true, {}); }},
    {"visibility_network/one_list", [](Extent) { return links(3, false, {.particles = 40, .lines = 2, .window = 1}); }},
    {"visibility_network/one_particle", [](Extent) { return links(3, false, {.particles = 1, .lines = 1, .window = 1}); }},
};

}  // namespace

std::span<const NamedCase> visibility_network_cases() { return cases; }

}  // namespace airlight
