#include "common/plan/gaussian_light_volumes.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/error.h"
#include "common/plan/gaussian_shadows.h"

namespace airlight {

namespace {

constexpr double most_cells = 128;  // along an edge of a volume that nobody asked for
constexpr int finest_cells = 512;
constexpr double small_volume = 64;  // cells along an edge: as good as free

// Small volumes have two thirds more than are asked for: beside a lamp in one bright pixel three cells a radius leave 2.5 %.
double cells_for(const Scene& scene, const std::vector<GaussianDensity>& gaussians, double cells_a_radius) {
  const double asked = cells_for_radius(scene, gaussians, cells_a_radius);
  return std::max(asked, std::min(std::ceil(asked * 5 / 3), small_volume));
}

}  // namespace

LightVolumes add_gaussian_light_volumes(FramePlan& frame, const std::vector<GaussianDensity>& gaussians,
                                        std::uint32_t injected_id, std::uint32_t depths_id) {
  const std::string_view path = frame.request.knobs.choice("light_path");
  const auto skip = [&](const char* why) {
    frame.plan.skips.push_back({Rule::no_light_volumes, "optical_depth_propagation", why});
    return LightVolumes{};
  };
  if (gaussians.empty() || frame.lights.empty()) return skip(gaussians.empty() ? "no Gaussian" : "no light");
  if (path == "exact") return skip("closed forms are wanted");
  if (path == "published" && !frame.has_surfaces()) return skip("only surfaces have their light from volumes");
  const double cells = cells_for(frame.scene, gaussians, frame.request.knobs.number("light_cells"));
  const bool if_worth_it = path != "volume";
  if (if_worth_it && gaussians.size() <= few_gaussians) return skip("closed forms of few Gaussians are faster");
  if (if_worth_it && cells > most_cells) return skip("the smallest Gaussian is small beside them all: closed forms");
  if (cells > finest_cells)
    throw InputError("setting light_cells: the volume would have " +
                     std::to_string(static_cast<long long>(std::min(cells, 1e15))) + " cells along an edge, expected at most " +
                     std::to_string(finest_cells));
  const MediumBox box = medium_box(frame.scene, std::max(static_cast<int>(cells), 2));
  Density density{gaussians_of(frame.scene, box.corner), {}, {}};
  // A ray through many is looked up on a grid of the same cells.
  if (gaussians.size() > few_gaussians) {
    const Buffer extinction = add_density_injection(frame, box, density, 0, injected_id);
    density = {{}, extinction, box_density(box, glm::vec3(1), box.corner)};
  }
  return add_light_volumes(
      frame, box,
      {.from = density, .cells = false, .samples = 2, .floats = density.voxels.bytes / sizeof(float), .knob = "light_cells"},
      depths_id);
}

}  // namespace airlight
