// 64-bit content hashes: names for "the same content as before", never for security.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/algorithms/depth_volume.h"
#include "common/algorithms/medium.h"
#include "common/algorithms/view.h"

namespace airlight {

class Hash {
 public:
  void bytes(std::span<const std::byte>);

  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(T v) {
    if constexpr (std::is_floating_point_v<T>) v += T(0);  // -0 and 0 are one value
    bytes(std::as_bytes(std::span(&v, 1)));
  }
  void add(std::string_view s) {
    add(s.size());
    bytes(std::as_bytes(std::span(s)));
  }
  void add(glm::vec2 v) { add(v.x), add(v.y); }
  void add(glm::vec3 v) { add(v.x), add(v.y), add(v.z); }
  void add(Extent e) { add(e.width), add(e.height); }
  void add(const View& v) {
    add(v.right), add(v.up), add(v.forward), add(v.tan_half_fov), add(v.near_plane), add(v.offset), add(v.extent);
  }
  void add(const Light& l) { add(l.vector), add(l.power), add(l.radius), add(l.directional); }
  void add(const Phase& p) { add(p.kind), add(p.g); }
  void add(const Material& m) { add(m.diffuse), add(m.specular), add(m.shininess); }
  void add(const glm::vec4& v) { add(v.x), add(v.y), add(v.z), add(v.w); }
  void add(const GaussianDensity& g) {
    add(g.center), add(g.radius), add(g.extinction), add(g.reach), add(g.albedo), add(g.emission);
  }
  void add(const RayNoise& n) { add(n.amplitude), add(n.scale), add(n.offset); }
  void add(const GridDensity& g) {
    for (const glm::vec4& row : g.cells) add(row);
    add(g.size), add(g.albedo), add(g.half_unit);
  }
  void add(const DepthVolume& d) {
    add(d.kind), add(d.first), add(d.scale), add(d.nodes), add(d.halves);
    for (const glm::vec4& row : d.rows) add(row);
  }
  void add(const DepthLattice& l) { add(l.corner), add(l.spacing), add(l.nodes.x), add(l.nodes.y), add(l.nodes.z), add(l.first); }
  template <class T>
  void add(const std::vector<T>& v) {
    add(v.size());
    for (const T& x : v) add(x);
  }

  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0x9e3779b97f4a7c15U;
};

}  // namespace airlight
