// Volumes about a scene's Gaussians and grid: the box of cells that holds their extinction, and where optical depths toward a
// light are kept.
#pragma once

#include <glm/vec3.hpp>

#include "common/algorithms/depth_volume.h"
#include "common/algorithms/optical_depth_propagation.h"
#include "common/scene/scene.h"

namespace airlight {

// A box of cubes, its edges along the world's axes. It holds every Gaussian as far as it reaches (gaussians_of()) and the grid.
struct MediumBox {
  glm::dvec3 corner{0, 0, 0};  // [m], the least
  double cell = 0;             // [m]
  glm::ivec3 cells{0, 0, 0};   // an axis, each at least 2; 0: the scene has neither

  explicit operator bool() const { return cells.x > 0; }
  glm::dvec3 size() const { return glm::dvec3(cells) * cell; }
};
// `resolution`: cells of the longest edge, > 1.
MediumBox medium_box(const Scene&, int resolution);
// The same of Gaussians as far as they matter to `lost_depth`, lamps or not.
MediumBox medium_box(const Scene&, int resolution, double lost_depth);

// The volume of a light's depths, as fine as the box's cells where the medium ends, seen from `origin`.
DepthVolume depth_volume(const MediumBox&, const LightSource&, const glm::dvec3& origin);
// The box's own cells.
DepthVolume cell_volume(const MediumBox&, const glm::dvec3& origin);

// The box as a grid, seen from `origin`.
GridDensity box_density(const MediumBox&, const glm::vec3& albedo, const glm::dvec3& origin);

}  // namespace airlight
