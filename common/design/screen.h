// Between the screen and the world. The same bits on every machine: nothing of the C library but square roots.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/design/edits.h"
#include "common/scene/scene.h"

namespace airlight {

class Screen {
 public:
  explicit Screen(const Camera&);

  // Unit direction of the view ray of a place on the screen (edits.h).
  glm::dvec3 ray(const glm::dvec2& at) const;

  // Where a point of the world is seen, and its depth along the camera's axis [m]; none behind the camera.
  struct Seen {
    glm::dvec2 at{0, 0};
    double depth = 0;
  };
  std::optional<Seen> seen(const glm::dvec3& point) const;

  // Where the view ray meets a plane in front of the camera, not beyond 1e6 m.
  std::optional<glm::dvec3> on_plane(const glm::dvec2& at, const DesignPlane&) const;

  // [m] of half the screen's height at a depth of 1 m: tan(fov / 2).
  double half_height() const { return half_height_; }
  const glm::dvec3& forward() const { return forward_; }
  const glm::dvec3& right() const { return right_; }
  const glm::dvec3& up() const { return up_; }

 private:
  glm::dvec3 position_, forward_, right_, up_;
  double half_height_ = 1;
};

// A stroke's points in the world. Throws InputError for a stroke without points, with both kinds of them, on the screen without a
// plane, or where a view ray does not meet it.
std::vector<glm::dvec3> world_points(const Stroke&, const Screen&);

}  // namespace airlight
