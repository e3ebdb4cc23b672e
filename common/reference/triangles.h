// The surfaces' triangles in double, relative to the camera, in a hierarchy of boxes that never miss one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/scene/scene.h"

namespace airlight {

// Embree builds the hierarchy (its boxes are float, enlarged beyond any rounding); it is walked, and every triangle in it is
// tested, in double. No Embree object outlives the constructor.
class Triangles {
 public:
  struct Triangle {
    std::array<std::uint32_t, 3> corner{};  // index of position()
    std::uint32_t surface = 0;
  };
  struct Box {
    std::array<float, 3> low{}, high{};
  };

  explicit Triangles(const Scene&);

  std::size_t size() const { return triangles_.size(); }
  const Triangle& operator[](std::size_t i) const { return triangles_[i]; }
  const glm::dvec3& position(const Triangle& t, int corner) const {
    return positions_[t.corner[static_cast<std::size_t>(corner)]];
  }
  const glm::dvec3& normal(const Triangle& t, int corner) const { return normals_[t.corner[static_cast<std::size_t>(corner)]]; }

  // visit(triangle index) for each triangle in a box that meets(box) accepts; stops when visit returns false.
  template <class Meets, class Visit>
  void walk(Meets&& meets, Visit&& visit) const {
    if (triangles_.empty()) return;
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
      const Node& node = nodes_[stack.back()];
      stack.pop_back();
      for (std::size_t side = 0; side < 2; ++side) {
        const Child& child = node.child[side];
        if (child.empty || !meets(child.box)) continue;
        if (child.count == 0) {
          stack.push_back(child.first);
          continue;
        }
        for (std::uint32_t i = 0; i < child.count; ++i) {
          if (!visit(leaves_[child.first + i])) return;
        }
      }
    }
  }

 private:
  struct Child {
    Box box;
    std::uint32_t first = 0;  // of nodes_, or of leaves_ where count is not 0
    std::uint32_t count = 0;
    bool empty = true;
  };
  struct Node {
    std::array<Child, 2> child;
  };
  void build();

  std::vector<glm::dvec3> positions_, normals_;
  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaves_;  // triangle indices, leaf by leaf
};

}  // namespace airlight
