#include "common/plan/light_volumes.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/algorithms/voxel_table.h"
#include "common/error.h"
#include "common/plan/gaussian_shadows.h"

namespace airlight {

namespace {

constexpr std::size_t most_floats = std::size_t{1} << 28U;  // of all volumes of a frame: 1 GiB

}  // namespace

double cells_for_radius(const Scene& scene, const std::vector<GaussianDensity>& gaussians, double cells_a_radius) {
  double radius = 1e300;
  for (const GaussianDensity& g : gaussians) radius = std::min(radius, smooth_radius(g));
  const double edge = 2 * medium_box(scene, 2).cell;
  return std::ceil(cells_a_radius * edge / radius);
}

Buffer add_density_injection(FramePlan& frame, const MediumBox& box, const Density& all, float half_unit, std::uint32_t id) {
  const Buffer extinction{{id}, sizeof(float) * voxel_table_floats(box.cells, half_unit > 0)};
  frame.plan.steps.push_back({DensityInjection{.gaussians = all.gaussians,
                                               .voxels = all.voxels,
                                               .grid = all.grid,
                                               .size = box.cells,
                                               .cell = static_cast<float>(box.cell),
                                               .half_unit = half_unit,
                                               .extinction = extinction},
                              "the medium's extinction on a grid"});
  return extinction;
}

LightVolumes add_light_volumes(FramePlan& frame, const MediumBox& box, const DepthSteps& steps, std::uint32_t first_id) {
  LightVolumes made;
  std::size_t floats = steps.floats;
  for (std::size_t k = 0; k < frame.lights.size(); ++k) {
    const LightSource& source = frame.scene.lights[frame.light_index[k]];
    const auto placed = [&](const glm::dvec3& origin) {
      DepthVolume v = steps.cells ? cell_volume(box, origin) : depth_volume(box, source, origin);
      v.halves = steps.halves;
      return v;
    };
    const DepthVolume volume = placed(box.corner);
    floats += volume.floats();
    const Buffer depths{{first_id + light_ids * frame.slot_of(k)}, sizeof(float) * volume.floats()};
    Light light = light_of(source, box.corner);
    light.power = glm::vec3(1);  // a light that only changes its power keeps its volume
    frame.plan.steps.push_back({OpticalDepthPropagation{.gaussians = steps.from.gaussians,
                                                        .voxels = steps.from.voxels,
                                                        .grid = steps.from.grid,
                                                        .light = light,
                                                        .volume = volume,
                                                        .scheme = steps.scheme,
                                                        .samples = steps.samples,
                                                        .depths = depths},
                                "the optical depth from a light to everywhere"});
    made.depths.push_back(depths);
    made.volumes.push_back(placed(frame.scene.camera.position));
  }
  if (floats > most_floats)
    throw InputError("setting " + std::string(steps.knob) + ": the volumes of " + std::to_string(frame.lights.size()) +
                     " lights would take " + std::to_string(floats >> 18U) + " MiB, expected at most " +
                     std::to_string(most_floats >> 18U));
  return made;
}

}  // namespace airlight
