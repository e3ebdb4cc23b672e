#include "tests/parity/inputs.h"
#include "tests/parity/medium.h"

namespace airlight {

namespace {

// One coarse lattice about the plane and a finer one about the sphere, or one node a surface.
std::vector<DepthLattice> lattices(bool one) {
  std::vector<DepthLattice> both{{{-6, -1.5F, -12}, 0.7F, {18, 2, 16}, 0}, {{-1, -1.2F, -5}, 0.25F, {9, 10, 7}, 0}};
  for (DepthLattice& l : both) l.nodes = one ? glm::ivec3(1) : l.nodes;
  both[1].first = both[0].nodes.x * both[0].nodes.y * both[0].nodes.z;
  return both;
}
std::size_t floats_of(const std::vector<DepthLattice>& all) {
  const glm::ivec3& last = all.back().nodes;
  return static_cast<std::size_t>(all.back().first + last.x * last.y * last.z + depth_lattice_padding);
}

Case found(Extent extent, int gaussians, const std::vector<DepthLattice>& about) {
  Case c;
  const View view = test_view(extent);
  const TestSurfaces surfaces = sphere_on_plane(view, 1);
  add_to(c, surfaces);
  MeanDepth step;
  if (!about.empty()) {
    std::vector<float> depths(floats_of(about));
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

Case nodes(int gaussians, const std::vector<DepthLattice>& about) {
  Case c;
  const Buffer depths{{1}, sizeof(float) * floats_of(about)};
  c.steps = {{MeanDepthLattice{.gaussians = test_gaussians(gaussians), .lattices = about, .depths = depths}, ""}};
  c.results = {{"depths", depths}};
  return c;
}

}  // namespace

std::span<const NamedCase> mean_depth_cases() {
  static constexpr NamedCase cases[] = {
      {"mean_depth/12_gaussians", [](Extent e) { return found(e, 12, {}); }},
      {"mean_depth/300_gaussians", [](Extent e) { return found(e, 300, {}); }},
      {"mean_depth/lattices", [](Extent e) { return found(e, 0, lattices(false)); }},
      {"mean_depth/a_node_a_surface", [](Extent e) { return found(e, 0, lattices(true)); }},
      {"mean_depth_lattice/300_gaussians", [](Extent) { return nodes(300, lattices(false)); }},
      {"mean_depth_lattice/a_node_a_surface", [](Extent) { return nodes(12, lattices(true)); }}};
  return cases;
}

}  // namespace airlight
