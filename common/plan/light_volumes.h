// The steps that make a scene's volumes: its extinction on a grid, and the optical depths toward each light.
#pragma once

#include <cstdint>
#include <vector>

#include "common/algorithms/optical_depth_propagation.h"
#include "common/plan/depth_volumes.h"
#include "common/plan/frame.h"

namespace airlight {

// What stands in the way of light and view: closed forms and a grid as they are in the scene, or one grid that holds them all.
struct Density {
  std::vector<GaussianDensity> gaussians;
  Buffer voxels;
  GridDensity grid;
};

// The depths of each of the plan's lights, and where they stand, seen from the camera.
struct LightVolumes {
  std::vector<Buffer> depths;
  std::vector<DepthVolume> volumes;
};

// Cells along the longest edge of the box about a scene's medium, so many in the radius of the smallest Gaussian that matters.
double cells_for_radius(const Scene&, const std::vector<GaussianDensity>&, double cells_a_radius);

// The step that puts `all`, seen from the box's corner, on the box's grid. half_unit: GridDensity's.
Buffer add_density_injection(FramePlan&, const MediumBox&, const Density& all, float half_unit, std::uint32_t id);

struct DepthSteps {
  Density from;  // seen from the box's corner
  bool cells;    // the volumes are those of the box's cells, and `from` is its grid
  DepthScheme scheme = DepthScheme::upwind;
  int samples = 1;                  // of the grid between two nodes of a ray
  bool halves = false;              // DepthVolume's
  std::size_t floats = 0;           // [float] of what else the plan keeps
  const char* knob = "resolution";  // which sets how fine they are
};
// Handles of each light, of which these volumes have the first.
constexpr std::uint32_t light_ids = 2;
// A step a light; ids from first_id on, light_ids apart. Throws InputError where all volumes of the plan would take more than 1
// GiB.
LightVolumes add_light_volumes(FramePlan&, const MediumBox&, const DepthSteps&, std::uint32_t first_id);

}  // namespace airlight
