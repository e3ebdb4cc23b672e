#pragma once

#include <glm/vec3.hpp>

#include "common/algorithms/field.h"
#include "common/algorithms/network.h"
#include "common/algorithms/view.h"
#include "common/image.h"

namespace airlight {

// What there is to scatter toward the camera: at each node of a box the mean of the radiance that arrives along all lines,
// weighed by the phase function. That radiance is the one of the node's own line of each bundle, between two particles of its
// list linear between what it is at them; light straight from the lights is not in it. (The paper splats the particles, which is
// noise, and means of the particles about a place would be too dark beside a light, where most of them lie deeper in the medium.)
struct SourceFunction {
  Buffer particles, lines, links, particle_sources, sky;  // as NetworkIteration's
  Phase phase;
  int particle_count = 1, line_count = 1;
  int window = 1;
  float unit = 1;             // [m] of the lattice
  glm::vec3 camera{0, 0, 0};  // [m] from the medium's middle; of an isotropic phase function it does not matter
  glm::vec3 first{0, 0, 0};   // the node of least coordinates, on the lattice
  int stride = 1;             // of the lattice, from node to node, > 0
  glm::vec3 nodes{2, 2, 2};   // an axis, each at least 2

  Buffer sources;  // [W/m^2/sr] the table of source_in_volume() (common/formulas/network.h), nodes sharpened for its lookups

  NetworkShape shape() const {
    const auto side = static_cast<std::size_t>(window);
    return {static_cast<std::size_t>(particle_count), static_cast<std::size_t>(line_count), side * side};
  }
  std::size_t floats() const {
    return 4 + 3 * static_cast<std::size_t>(nodes.x) * static_cast<std::size_t>(nodes.y) * static_cast<std::size_t>(nodes.z);
  }

  static constexpr std::string_view name = "source_function";
  static constexpr Domain domain = Domain::volume;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("particles"), s.particles);
    v(in("lines"), s.lines);
    v(in("links"), s.links);
    v(in("particle_sources", "W/m^2/sr"), s.particle_sources);
    v(in("sky", "W/m^2/sr"), s.sky);
    v(knob("phase"), s.phase);
    v(knob("particle_count"), s.particle_count);
    v(knob("line_count"), s.line_count);
    v(knob("window"), s.window);
    v(knob("unit", "m"), s.unit);
    v(knob("camera", "m"), s.camera);
    v(knob("first"), s.first);
    v(knob("stride"), s.stride);
    v(knob("nodes"), s.nodes);
    v(out("sources", "W/m^2/sr"), s.sources);
  }
};

}  // namespace airlight
