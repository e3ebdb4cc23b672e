#pragma once

#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/medium.h"
#include "common/algorithms/view.h"

namespace airlight {

// The mean optical depth of Gaussians over all directions (Zhou et al. 2007, eq. 26) from each surface that is seen: of each
// Gaussian at the place itself, or between the nodes of the surface's lattice.
struct MeanDepth {
  Image distance, material;                // as in SurfaceShading
  Buffer depths;                           // as MeanDepthLattice makes them, with lattices
  std::vector<DepthLattice> lattices;      // one a surface, seen from the camera; or none
  std::vector<GaussianDensity> gaussians;  // whatever their reach; without lattices
  View view;

  Image mean_depth;  // r32f; 0 where nothing is hit

  static constexpr std::string_view name = "mean_depth";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("material"), s.material);
    v(in("depths"), s.depths);
    v(knob("lattices"), s.lattices);
    v(knob("gaussians"), s.gaussians);
    v(knob("view"), s.view);
    v(out("mean_depth"), s.mean_depth);
  }
};

}  // namespace airlight
