#include "common/algorithms/voxel_table.h"
#include "common/plan/depth_volumes.h"
#include "common/plan/geometry.h"
#include "common/plan/voxels.h"
#include "tests/parity/medium.h"

namespace airlight {

namespace {

using Kind = DepthVolume::Kind;

// Beside the box, in it (not on a cell's face), far away, or shining obliquely.
LightSource light_for(Kind kind, const MediumBox& box) {
  const glm::dvec3 size = box.size();
  LightSource light;
  light.power = {1, 1, 1};
  light.position = box.corner + size * glm::dvec3(0.41, 0.57, 0.36);
  if (kind == Kind::frustum) light.position = box.corner + size * glm::dvec3(2.2, 1.7, -0.6);
  if (kind == Kind::parallel) {
    light.type = LightType::directional;
    light.direction = glm::normalize(glm::dvec3(0.5, -0.7, 0.2));
  }
  return light;
}

struct Parts {
  Kind kind = Kind::cube;
  int gaussians = 0;
  bool grid = false;
  int resolution = 16;
  bool cells = false;  // the volume is one of cells
  DepthScheme scheme = DepthScheme::upwind;
};

Case propagate(const Parts& parts) {
  Case c;
  Scene scene = test_gaussian_scene(parts.gaussians);
  if (parts.grid) scene.medium.grid = test_grid();
  const MediumBox box = medium_box(scene, parts.resolution);
  const LightSource light = light_for(parts.kind, box);
  OpticalDepthPropagation p;
  p.gaussians = gaussians_of(scene, box.corner);
  if (parts.grid) {
    p.voxels = add_voxels(c, *scene.medium.grid, 1);
    p.grid = grid_density(*scene.medium.grid, box.corner);
  }
  if (parts.cells) {
    DensityInjection injection;
    injection.gaussians = p.gaussians, injection.voxels = p.voxels, injection.grid = p.grid;
    injection.size = box.cells;
    injection.cell = static_cast<float>(box.cell);
    injection.extinction = {{2}, sizeof(float) * voxel_table_floats(box.cells)};
    c.steps = {{injection, ""}};
    p.gaussians.clear();
    p.voxels = injection.extinction;
    p.grid = box_density(box, glm::vec3(1), box.corner);
  }
  p.light = light_of(light, box.corner);
  p.volume = parts.cells ? cell_volume(box, box.corner) : depth_volume(box, light, box.corner);
  p.scheme = parts.scheme;
  p.samples = parts.grid ? 3 : 1;
  p.depths = {{3}, sizeof(float) * p.volume.floats()};
  c.steps.push_back({p, ""});
  c.results = {{"depths", p.depths}};
  return c;
}

const NamedCase cases[] = {
    {"optical_depth_propagation/cube", [](Extent) { return propagate({.gaussians = 7}); }},
    {"optical_depth_propagation/frustum", [](Extent) { return propagate({.kind = Kind::frustum, .gaussians = 7}); }},
    {"optical_depth_propagation/parallel", [](Extent) { return propagate({.kind = Kind::parallel, .gaussians = 7}); }},
    {"optical_depth_propagation/many_gaussians", [](Extent) { return propagate({.gaussians = 200, .resolution = 10}); }},
    {"optical_depth_propagation/grid", [](Extent) { return propagate({.grid = true}); }},
    {"optical_depth_propagation/grid_from_afar",
     [](Extent) { return propagate({.kind = Kind::frustum, .gaussians = 3, .grid = true}); }},
    {"optical_depth_propagation/grid_in_the_sun", [](Extent) { return propagate({.kind = Kind::parallel, .grid = true}); }},
    {"optical_depth_propagation/upwind", [](Extent) { return propagate({.gaussians = 7, .grid = true, .cells = true}); }},
    {"optical_depth_propagation/upwind_from_afar",
     [](Extent) { return propagate({.kind = Kind::frustum, .gaussians = 7, .cells = true}); }},
    {"optical_depth_propagation/published_in_the_sun",
     [](Extent) { return propagate({.kind = Kind::parallel, .gaussians = 7, .cells = true, .scheme = DepthScheme::published}); }},
};

}  // namespace

std::span<const NamedCase> optical_depth_propagation_cases() { return cases; }

}  // namespace airlight
