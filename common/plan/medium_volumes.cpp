#include "common/plan/medium_volumes.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "common/error.h"
#include "common/plan/gaussian_shadows.h"
#include "common/plan/voxels.h"

namespace airlight {

namespace {

constexpr std::size_t few_gaussians = 4;  // that many are evaluated faster than a cell is looked up

// One grid has one albedo, and does not glow.
bool holds_in_a_grid(const Medium& medium) {
  const glm::dvec3* albedo = medium.grid ? &medium.grid->albedo : nullptr;
  for (const Gaussian& g : medium.gaussians) {
    if (!(g.extinction > 0)) continue;
    if (!albedo) albedo = &g.albedo;
    if (g.albedo != *albedo || g.emission != glm::dvec3(0)) return false;
  }
  return true;
}

glm::vec3 grid_albedo(const Medium& medium) { return medium.grid ? medium.grid->albedo : medium.gaussians.front().albedo; }

// What is looked up along rays needs more cells than depths, which are smoother: twice as many along an edge where the smallest
// Gaussian that matters has less than three in its radius. Nothing between, for cells must not follow each change of extinction.
MediumBox fine_box(const Scene& scene, const MediumBox& box) {
  constexpr double cells_a_radius = 3;
  const int cells = std::max({box.cells.x, box.cells.y, box.cells.z});
  const double wanted = cells_for_radius(scene, gaussians_of(scene, box.corner), cells_a_radius);
  return wanted <= cells ? box : medium_box(scene, 2 * cells);
}

}  // namespace

MediumVolumes::MediumVolumes(FramePlan& frame, std::uint32_t first_id) : frame_(frame) {
  const Medium& medium = frame.scene.medium;
  const KnobValues& knobs = frame.request.knobs;
  box_ = medium_box(frame.scene, static_cast<int>(knobs.number("resolution")));
  cells_ = knobs.choice("scheme") != "rays";
  halves_ = knobs.choice("storage") == "half";
  if (cells_ && halves_) throw InputError("setting storage: \"half\" is for scheme=rays, expected float");
  const std::string_view density = knobs.choice("density");
  const bool can = holds_in_a_grid(medium);
  if (density == "volume" && !can)
    throw InputError(
        "setting density: \"volume\" has one albedo and no emission, the scene's Gaussians have more; expected auto or exact");
  injected_ = box_ && can && (density == "volume" || (density == "auto" && medium.gaussians.size() > few_gaussians));
  fine_ = injected_ && !cells_ && density == "auto" ? fine_box(frame.scene, box_) : box_;
  if (medium.grid) {
    frame.plan.uploads.push_back(voxels_of(*medium.grid, first_id));
    native_ = frame.plan.uploads.back().buffer;
  }
  if (box_ && (injected_ || (cells_ && !frame.lights.empty()))) {
    extinction_ = add_density_injection(frame, fine_, as_given(fine_.corner), half_unit(), first_id + 1);
  } else if (box_) {
    frame.plan.skips.push_back({Rule::no_injection, "density_injection",
                                medium.gaussians.size() <= few_gaussians
                                    ? "a grid as it is and a few Gaussians in closed form are faster"
                                    : "Gaussians of several albedos, that glow, or wanted in closed form"});
  }
}

Density MediumVolumes::as_given(const glm::dvec3& origin) const {
  Density d;
  d.gaussians = gaussians_of(frame_.scene, origin);
  if (const auto& grid = frame_.scene.medium.grid) d.voxels = native_, d.grid = grid_density(*grid, origin);
  return d;
}

// A power of 2: no extinction is above 2^14 of it, twice of which sharpened ones may have, and thin ones have all their digits.
float MediumVolumes::half_unit() const {
  if (!halves_) return 0;
  const Medium& medium = frame_.scene.medium;
  double most = 0;
  for (const Gaussian& g : medium.gaussians) most += g.extinction;
  if (const auto& grid = medium.grid; grid && !grid->voxels->values.empty())
    most += static_cast<double>(*std::max_element(grid->voxels->values.begin(), grid->voxels->values.end())) * grid->scale;
  return static_cast<float>(std::exp2(std::clamp(std::ceil(std::log2(std::max(most, 1e-30))) - 14, -100.0, 100.0)));
}

Density MediumVolumes::injected(const glm::dvec3& origin) const {
  Density d{{}, extinction_, box_density(fine_, grid_albedo(frame_.scene.medium), origin)};
  d.grid.half_unit = half_unit();
  return d;
}

Density MediumVolumes::to_march() const {
  const glm::dvec3& camera = frame_.scene.camera.position;
  return injected_ ? injected(camera) : as_given(camera);
}

// How many lookups between two nodes of a light's ray the grid is worth.
int MediumVolumes::samples(bool in_cells) const {
  double finest = fine_.cell;
  if (const auto& grid = frame_.scene.medium.grid; grid && !in_cells) {
    for (int axis = 0; axis < 3; ++axis) finest = std::min(finest, glm::length(glm::dvec3(grid->transform[axis])));
  }
  return std::clamp(static_cast<int>(std::ceil(1.5 * box_.cell / finest)), 1, 8);
}

LightVolumes MediumVolumes::propagate(std::uint32_t first_id) const {
  if (!box_ || frame_.lights.empty()) {
    frame_.plan.skips.push_back(
        {Rule::no_light_volumes, "optical_depth_propagation", box_ ? "no light" : "the medium is homogeneous"});
    return {};
  }
  const DepthScheme scheme = frame_.request.knobs.choice("scheme") == "published" ? DepthScheme::published : DepthScheme::upwind;
  return add_light_volumes(frame_, box_,
                           {.from = cells_ || injected_ ? injected(box_.corner) : as_given(box_.corner),
                            .cells = cells_,
                            .scheme = scheme,
                            .samples = samples(cells_ || injected_),
                            .halves = halves_,
                            .floats = extinction_.bytes / sizeof(float)},
                           first_id);
}

}  // namespace airlight
