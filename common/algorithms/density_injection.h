#pragma once

#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/medium.h"
#include "common/image.h"

namespace airlight {

// The extinction of Gaussians and of a grid at the centres of a box of cubes, laid out as common/algorithms/voxel_table.h tells,
// so that it is a grid itself. Places are metres from the box's corner, whatever the camera does. Of a Gaussian, as
// injected_gaussian() in common/formulas/depth_volume.h tells; the grid is looked up at the centres.
struct DensityInjection {
  std::vector<GaussianDensity> gaussians;  // those of equal albedo that do not glow
  Buffer voxels;                           // the grid's, with a grid
  GridDensity grid;                        // from where the box's corner is
  glm::vec3 size{0, 0, 0};                 // cells an axis, each > 1
  float cell = 1;                          // [m]
  float half_unit = 0;                     // [1/m] as GridDensity's, of what is made

  Buffer extinction;  // [1/m]

  static constexpr std::string_view name = "density_injection";
  static constexpr Domain domain = Domain::volume;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(knob("gaussians"), s.gaussians);
    v(in("voxels", "1/m"), s.voxels);
    v(knob("grid"), s.grid);
    v(knob("size"), s.size);
    v(knob("cell", "m"), s.cell);
    v(knob("half_unit", "1/m"), s.half_unit);
    v(out("extinction", "1/m"), s.extinction);
  }
};

}  // namespace airlight
