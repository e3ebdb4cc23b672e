#include "tests/parity/inputs.h"
#include "tests/parity/medium.h"

namespace airlight {

namespace {

Case found(Extent extent, int gaussians, const std::vector<DepthLattice>& about) {
  Case c;
  const View view = test_view(extent);
  const TestSurfaces surfaces = sphere_on_plane(view, 1);
  add_to(c, surfaces);
  MeanDepth step;
  if (!about.empty()) {
    std::vector<float> depths(lattice_floats(about));
    for (std::uint32_t i = 0; i + depth_lattice_padding < depths.size(); ++i) depths[i] = static_cast<float>(1 + uniform(11, i));
    const auto bytes = std::as_bytes(std::span(depths));
    step.depths = {{4}, bytes.size()};
    c.buffers.emplace_back(step.depths, std::vector<std::byte>(bytes.begin(), bytes.end()));
  }
  step.distance = surfaces.distance, step.material = surfaces.material;
  step.lattices = about, step.view = view;
  step.gaussians = test_gaussians(gaussians);
  step.mean_depth = {{5}, Format::r32f, extent, 1, true};
  c.steps = {{step, ""}};
  c.results = {{"mean_depth", step.mean_depth}};
  return c;
}

}  // namespace

std::span<const NamedCase> mean_depth_cases() {
  static constexpr NamedCase cases[] = {
      {"mean_depth/12_gaussians", [](Extent e) { return found(e, 12, {}); }},
      {"mean_depth/300_gaussians", [](Extent e) { return found(e, 300, {}); }},
      {"mean_depth/lattices", [](Extent e) { return found(e, 0, test_lattices(false)); }},
      {"mean_depth/a_node_a_surface", [](Extent e) { return found(e, 0, test_lattices(true)); }}};
  return cases;
}

}  // namespace airlight
