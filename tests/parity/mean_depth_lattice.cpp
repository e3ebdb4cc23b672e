#include "tests/parity/medium.h"

namespace airlight {

namespace {

Case nodes(int gaussians, const std::vector<DepthLattice>& about) {
  Case c;
  const Buffer depths{{1}, sizeof(float) * lattice_floats(about)};
  c.steps = {{MeanDepthLattice{.gaussians = test_gaussians(gaussians), .lattices = about, .depths = depths}, ""}};
  c.results = {{"depths", depths}};
  return c;
}

}  // namespace

std::span<const NamedCase> mean_depth_lattice_cases() {
  static constexpr NamedCase cases[] = {
      {"mean_depth_lattice/300_gaussians", [](Extent) { return nodes(300, test_lattices(false)); }},
      {"mean_depth_lattice/a_node_a_surface", [](Extent) { return nodes(12, test_lattices(true)); }}};
  return cases;
}

}  // namespace airlight
