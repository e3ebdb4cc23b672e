#pragma once

#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/medium.h"
#include "common/algorithms/network.h"
#include "common/image.h"

namespace airlight {

// Which particles light meets one after another along each line of each bundle, and what the links between them do to it
// (Szirmay-Kalos et al. 2005, 3.1): particles are projected along the bundle, those of a pixel are sorted in depth, and are taken
// to lie on one line, through the mean of their places in it, whose optical depths are exact in Gaussians. (Through the pixel's
// centre it has three times the error, most of it light that is missing.) Places are metres from the middle of the
// medium, whatever the camera does.
struct VisibilityNetwork {
  Buffer particles, lines;  // common/algorithms/network.h
  Buffer voxels;            // the grid's, with a grid
  std::vector<GaussianDensity> gaussians;
  GridDensity grid;
  int particle_count = 1, line_count = 1;
  int window = 1;        // pixels a side of a square window: window^2 slots
  float unit = 1;        // [m] of the lattice
  float extinction = 0;  // [1/m] of the homogeneous part, which takes light between particles
  int samples = 8;       // of the grid in a link, > 0

  Buffer links;

  NetworkShape shape() const {
    const auto side = static_cast<std::size_t>(window);
    return {static_cast<std::size_t>(particle_count), static_cast<std::size_t>(line_count), side * side};
  }

  static constexpr std::string_view name = "visibility_network";
  static constexpr Domain domain = Domain::volume;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("particles"), s.particles);
    v(in("lines"), s.lines);
    v(in("voxels", "1/m"), s.voxels);
    v(knob("gaussians"), s.gaussians);
    v(knob("grid"), s.grid);
    v(knob("particle_count"), s.particle_count);
    v(knob("line_count"), s.line_count);
    v(knob("window"), s.window);
    v(knob("unit", "m"), s.unit);
    v(knob("extinction", "1/m"), s.extinction);
    v(knob("samples"), s.samples);
    v(out("links"), s.links);
  }
};

}  // namespace airlight
