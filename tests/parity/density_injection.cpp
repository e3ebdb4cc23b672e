#include "common/algorithms/voxel_table.h"
#include "common/plan/depth_volumes.h"
#include "common/plan/geometry.h"
#include "common/plan/voxels.h"
#include "tests/parity/medium.h"

namespace airlight {

namespace {

Case inject(int gaussians, bool grid, int resolution) {
  Case c;
  Scene scene = test_gaussian_scene(gaussians);
  if (grid) scene.medium.grid = test_grid();
  const MediumBox box = medium_box(scene, resolution);
  DensityInjection injection;
  injection.gaussians = gaussians_of(scene, box.corner);
  if (grid) {
    injection.voxels = add_voxels(c, *scene.medium.grid, 1);
    injection.grid = grid_density(*scene.medium.grid, box.corner);
  }
  injection.size = box.cells;
  injection.cell = static_cast<float>(box.cell);
  injection.extinction = {{2}, sizeof(float) * voxel_table_floats(box.cells)};
  c.steps = {{injection, ""}};
  c.results = {{"extinction", injection.extinction}};
  return c;
}

const NamedCase cases[] = {
    {"density_injection/gaussians", [](Extent) { return inject(7, false, 40); }},
    {"density_injection/many_gaussians", [](Extent) { return inject(300, false, 20); }},
    {"density_injection/grid", [](Extent) { return inject(0, true, 23); }},
    {"density_injection/coarse", [](Extent) { return inject(5, true, 2); }},
};

}  // namespace

std::span<const NamedCase> density_injection_cases() { return cases; }

}  // namespace airlight
