// What the plans of all techniques make of mean optical depths about surfaces, by which an environment's light is attenuated.
#include <algorithm>
#include <string>

#include "common/error.h"
#include "common/plan/frame.h"
#include "common/plan/frame_ids.h"
#include "common/plan/gaussian_light_volumes.h"
#include "common/plan/gaussian_shadows.h"
#include "common/plan/grid_gaussians.h"
#include "common/plan/surface_lattices.h"

namespace airlight {

namespace {

constexpr double most_nodes = 1 << 21;
constexpr double pixels_a_node = 4;  // that many take longer than a node does, lookups among them

}  // namespace

Knob environment_depth_knob() {
  return choice_knob(
      "environment_depth", {"auto", "pixel", "lattice", "object"},
      "where the mean depths of Gaussians and grids are found by which surfaces have an environment's light: at each "
      "pixel's place; between nodes about each surface; auto: those for more than 16 Gaussians or blocks of a grid, unless "
      "they are more than a quarter of the pixels; object: once in the middle of each surface, as Zhou et al. have it");
}

Knob environment_cells_knob() {
  return number_knob("environment_cells", "2", 0.25, 16,
                     "of those nodes in the radius of the smallest Gaussian, and in two edges of a block of a grid");
}

Knob environment_blocks_knob() {
  return integer_knob("environment_blocks", "16", 1, 32,
                      "of a grid's cells along its longest edge, each of which counts as a Gaussian in those depths");
}

// Absent where there is none.
Image FramePlan::mean_depth() {
  if (mean_depth_ || !has_surfaces()) return mean_depth_;
  const auto& grid = scene.medium.grid;
  const GridBlocks blocks =
      grid ? grid_blocks(*grid, static_cast<int>(request.knobs.number("environment_blocks"))) : GridBlocks{};
  const auto seen_from = [&](const glm::dvec3& place) {
    std::vector<GaussianDensity> all = gaussians_of(scene, place);
    if (!grid) return all;
    const std::vector<GaussianDensity> of_grid = grid_gaussians(*grid, blocks, place);
    all.insert(all.end(), of_grid.begin(), of_grid.end());
    return all;
  };
  const std::vector<GaussianDensity> own = gaussians_of(scene);
  const double count = static_cast<double>(own.size()) + (grid ? blocks.count() : 0);
  if (!(count > 0)) return {};
  const std::string_view choice = request.knobs.choice("environment_depth");
  const auto skip = [&](const std::string& why) {
    plan.skips.push_back({Rule::no_depth_lattice, "mean_depth_lattice", why});
    return SurfaceLattices{};
  };
  const auto lattices = [&] {
    // Blocks lie side by side: what they make together changes more slowly than one of them.
    double radius = grid ? 2 * blocks.edge : 1e30;  // of faint ones may be more than a float holds
    for (const GaussianDensity& g : own) radius = std::min(radius, smooth_radius(g));
    const double pixels = static_cast<double>(request.extent.width) * request.extent.height;
    const double most = choice == "auto" ? std::min(pixels / pixels_a_node, most_nodes) : most_nodes;
    SurfaceLattices all = surface_lattices(scene, radius / request.knobs.number("environment_cells"), most);
    if (!all.lattices.empty()) return all;
    if (choice == "auto")
      return skip("the smallest Gaussian or block is small beside the surfaces: closed forms at each pixel are as fast");
    throw InputError("setting environment_cells: the lattices would have " +
                     std::to_string(static_cast<long long>(std::min(all.nodes, 1e15))) + " nodes, expected at most " +
                     std::to_string(static_cast<long long>(most_nodes)));
  };
  SurfaceLattices about;
  if (choice == "object") {
    about = surface_middles(scene);
  } else if (choice == "pixel") {
    about = skip("they are wanted at each pixel");
  } else if (choice == "auto" && count <= few_gaussians) {
    about = skip("closed forms of few Gaussians are faster");
  } else {
    about = lattices();
  }

  MeanDepth step;
  if (!about.lattices.empty()) {
    step.depths = {{mean_depths_id}, sizeof(float) * (static_cast<std::size_t>(about.nodes) + depth_lattice_padding)};
    plan.steps.push_back(
        {MeanDepthLattice{.gaussians = seen_from(about.origin), .lattices = about.lattices, .depths = step.depths},
         grid ? "optical depths over all directions from places about the surfaces; the grid by blocks"
              : "optical depths over all directions from places about the surfaces"});
    step.lattices = about.from(scene.camera.position);
  } else {
    step.gaussians = seen_from(scene.camera.position);
  }
  mean_depth_ = handed_on(next_id_++, Format::r32f, 1);
  step.distance = distance, step.material = material, step.view = view;
  step.mean_depth = mean_depth_;
  plan.steps.push_back({step, grid && about.lattices.empty()
                                  ? "the optical depth over all directions from the surfaces; the grid by blocks"
                                  : "the optical depth over all directions from the surfaces"});
  return mean_depth_;
}

}  // namespace airlight
