// The surfaces as what is lit: vertices, each with what is hidden from both of its sides, and triangles that are cut where that
// changes along an edge.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <unordered_map>
#include <vector>

#include "common/plan/surface_transfer.h"
#include "common/progress.h"
#include "common/transfer/hidden_sphere.h"

namespace airlight {

class Receivers {
 public:
  // Scene, occluders and directions must outlive it.
  Receivers(const Scene&, const Occluders&, const SphereOfDirections&, int threads, Progress&);

  // What is hidden from the vertices; then cuts edges in two until it is nearly linear along them, no shorter than 1/32 of the
  // smallest caster, and no more than 100000. The same for any number of threads.
  SurfaceTransfer transfer();

 private:
  using Edge = std::uint64_t;  // two vertices, the lower one first
  struct Place {
    glm::dvec3 position{0}, normal{0};  // the normal of any length
    std::uint32_t weld = 0;             // the same for vertices at the same place, so that no crack opens between them
    std::array<HiddenSphere, 2> sides;
  };
  static Edge edge(std::uint32_t a, std::uint32_t b) { return a < b ? Edge{a} << 32U | b : Edge{b} << 32U | a; }
  Edge welded(Edge e) const { return edge(places_[e >> 32U].weld, places_[e & 0xffffffffU].weld); }
  double length(Edge) const;

  void look(Place&, std::span<const std::uint32_t> triangles) const;
  Place midway(Edge) const;
  bool bends(Edge, const Place& middle) const;
  void look_from_vertices();
  void look_from_long_edges();
  bool cut();
  void each(std::size_t count, const char* what, const std::function<void(std::size_t)>& body) const;

  const Occluders& occluders_;
  const SphereOfDirections& directions_;
  int threads_;
  Progress& progress_;
  double shortest_ = 0;
  std::vector<Place> places_;
  std::vector<glm::uvec4> triangles_;
  std::vector<glm::uvec2> midpoints_;
  std::size_t own_ = 0;  // vertices of the scene
  struct Middle {
    Place place;
    bool bends = false;
  };
  std::unordered_map<Edge, Middle> middles_;                // of long edges
  std::unordered_map<Edge, std::uint32_t> weld_of_middle_;  // by welded edge
  std::uint32_t welds_ = 0;
};

}  // namespace airlight
