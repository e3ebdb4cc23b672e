#pragma once

#include <vector>

#include "common/algorithms/depth_volume.h"
#include "common/algorithms/field.h"
#include "common/algorithms/medium.h"
#include "common/algorithms/view.h"

namespace airlight {

// How the depth at a cell comes from those of its neighbours nearer to the light: as Giroud and Biri print it (eq. 6), with the
// cell's size put in, which counts the way across a diagonal axis by axis; or consistently (upwind). Volumes along the light's
// rays need no scheme: a node's depth is the one before it and what lies between.
enum class DepthScheme : int { published, upwind };

// The optical depth of Gaussians and grid from a light to each node of a volume. Places are metres from the corner of the box
// about the medium, whatever the camera does, so that a volume holds as long as light and medium stand still.
struct OpticalDepthPropagation {
  std::vector<GaussianDensity> gaussians;  // in closed form; none where the volume is one of cells
  Buffer voxels;                           // with a grid; of cells, the extinction of exactly these cells
  GridDensity grid;
  Light light;
  DepthVolume volume;
  DepthScheme scheme = DepthScheme::upwind;  // of cells
  int samples = 1;                           // of the grid between two nodes of a ray, > 0

  Buffer depths;

  static constexpr std::string_view name = "optical_depth_propagation";
  static constexpr Domain domain = Domain::volume;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(knob("gaussians"), s.gaussians);
    v(in("voxels", "1/m"), s.voxels);
    v(knob("grid"), s.grid);
    v(knob("light"), s.light);
    v(knob("volume"), s.volume);
    v(knob("scheme"), s.scheme);
    v(knob("samples"), s.samples);
    v(out("depths"), s.depths);
  }
};

}  // namespace airlight
