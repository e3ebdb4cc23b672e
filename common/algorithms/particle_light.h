#pragma once

#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/medium.h"
#include "common/algorithms/network.h"
#include "common/algorithms/view.h"

namespace airlight {

// The source of each particle before any light goes from one to another: what it scatters of the lights, attenuated by the medium
// on their way, and what it emits. Of an isotropic phase function one source a particle, else one in each direction: both ways
// of each line, that along it first; together as much of each light as an isotropic one has.
struct ParticleLight {
  Buffer particles, lines;
  Buffer voxels;  // the grid's, with a grid
  std::vector<Light> lights;
  std::vector<GaussianDensity> gaussians;
  GridDensity grid;
  Phase phase;
  int particle_count = 1, line_count = 1;
  float unit = 1;        // [m] of the lattice
  float extinction = 0;  // [1/m] of the homogeneous part: it attenuates point lights
  int light_steps = 16;  // through the grid, > 0

  Buffer first;  // [W/m^2/sr] rgb and an unused float a particle, direction after direction

  static constexpr std::string_view name = "particle_light";
  static constexpr Domain domain = Domain::volume;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("particles"), s.particles);
    v(in("lines"), s.lines);
    v(in("voxels", "1/m"), s.voxels);
    v(knob("lights"), s.lights);
    v(knob("gaussians"), s.gaussians);
    v(knob("grid"), s.grid);
    v(knob("phase"), s.phase);
    v(knob("particle_count"), s.particle_count);
    v(knob("line_count"), s.line_count);
    v(knob("unit", "m"), s.unit);
    v(knob("extinction", "1/m"), s.extinction);
    v(knob("light_steps"), s.light_steps);
    v(out("first", "W/m^2/sr"), s.first);
  }
};

}  // namespace airlight
