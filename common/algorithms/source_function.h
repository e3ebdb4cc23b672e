#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/network.h"
#include "common/algorithms/view.h"
#include "common/image.h"

namespace airlight {

// What there is to scatter toward the camera: at each node of a box, or of those bricks of one that have any, the mean of the
// radiance that arrives along all lines, weighed by the phase function. That radiance is the one of the node's own line of each
// bundle, between two particles of its list linear between what it is at them; light straight from the lights is not in it. (The
// paper splats the particles, which is noise, and means of the particles about a place would be too dark beside a light, where
// most of them lie deeper in the medium.)
struct SourceFunction {
  Buffer particles, lines, links, particle_sources, sky;  // as NetworkIteration's
  Phase phase;
  int particle_count = 1, line_count = 1;
  int window = 1;
  float unit = 1;                       // [m] of the lattice
  glm::vec3 camera{0, 0, 0};            // [m] from the medium's middle; of an isotropic phase function it does not matter
  glm::vec3 first{0, 0, 0};             // the node of least coordinates, on the lattice
  int stride = 1;                       // of the lattice, from node to node, > 0
  glm::vec3 nodes{2, 2, 2};             // an axis of a brick, each at least 2
  glm::vec3 bricks{1, 1, 1};            // an axis, side by side: nodes between two of them are those of both
  std::vector<std::int32_t> filled{0};  // numbers, ascending, of the bricks that have nodes, x fastest

  Buffer sources;  // [W/m^2/sr] the table of source_in_volume() (common/formulas/network.h), nodes sharpened for its lookups

  NetworkShape shape() const {
    const auto side = static_cast<std::size_t>(window);
    return {static_cast<std::size_t>(particle_count), static_cast<std::size_t>(line_count), side * side};
  }
  static std::size_t product(const glm::vec3& v) {
    return static_cast<std::size_t>(v.x) * static_cast<std::size_t>(v.y) * static_cast<std::size_t>(v.z);
  }
  std::size_t all_nodes() const { return filled.size() * product(nodes); }
  std::size_t head_floats() const { return 8 + product(bricks); }
  std::size_t floats() const { return head_floats() + 3 * all_nodes(); }
  // How the table begins, but for its largest value.
  std::vector<float> head() const {
    const auto all = static_cast<float>(head_floats());
    std::vector<float> head{nodes.x, nodes.y, nodes.z, 0, bricks.x, bricks.y, bricks.z, all};
    head.resize(head_floats(), -1.0F);
    for (std::size_t k = 0; k < filled.size(); ++k) head[8 + static_cast<std::size_t>(filled[k])] = static_cast<float>(k);
    return head;
  }
  // Where in the row of bricks of each axis the k-th one with nodes is.
  std::array<std::int32_t, 3> brick(std::size_t k) const {
    const auto x = static_cast<std::int32_t>(bricks.x), y = static_cast<std::int32_t>(bricks.y);
    return {filled[k] % x, filled[k] / x % y, filled[k] / x / y};
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
    v(knob("bricks"), s.bricks);
    v(knob("filled"), s.filled);
    v(out("sources", "W/m^2/sr"), s.sources);
  }
};

}  // namespace airlight
