#pragma once

#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/medium.h"
#include "common/image.h"

namespace airlight {

// The mean optical depth of Gaussians over all directions (Zhou et al. 2007, eq. 26) at the nodes of lattices, one about each
// surface. Places are told from a place of the scene's own, whatever the camera does.
struct MeanDepthLattice {
  std::vector<GaussianDensity> gaussians;  // whatever their reach
  std::vector<DepthLattice> lattices;      // one behind the other

  Buffer depths;  // of all nodes, then depth_lattice_padding zeros

  static constexpr std::string_view name = "mean_depth_lattice";
  static constexpr Domain domain = Domain::volume;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(knob("gaussians"), s.gaussians);
    v(knob("lattices"), s.lattices);
    v(out("depths"), s.depths);
  }
};

}  // namespace airlight
