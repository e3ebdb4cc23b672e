// The plane through a view ray and a light, in which shadows on the ray are a matter of two dimensions.
#pragma once

#include <glm/vec3.hpp>

#include "common/reference/triangles.h"
#include "common/reference/visibility.h"

namespace airlight {

// Coordinates in the plane: x along the ray, y toward the light. A point light is at (foot, height); light of a directional one
// comes from (cosine, sine).
class ShadowPlane {
 public:
  // Ray from a point along a unit direction over 0..length (may be infinite).
  ShadowPlane(const glm::dvec3& origin, const glm::dvec3& direction, double length, const RelativeLight&);

  // Ray and light in one line, so that there is no such plane.
  bool degenerate() const { return degenerate_; }
  double foot() const { return foot_; }

  // False only for boxes that touch no line from the ray's part 0..length to the light.
  bool meets(const Triangles::Box&) const;

  // Shadow of a triangle on the ray's line; empty (begin > end) where it throws none. Triangles that share an edge get the same
  // end there, bit for bit.
  Interval shadow(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) const;

 private:
  struct Point {
    double x, y;
  };
  // Half-space normal.p <= bound, normal in the plane.
  struct Side {
    glm::dvec3 normal{0};
    double bound = 0;
  };
  Point in_plane(const glm::dvec3&) const;
  Point crossing(const glm::dvec3& a, double side_a, const glm::dvec3& b, double side_b) const;
  void add_shadow(Point, Point, Interval&) const;

  glm::dvec3 origin_, along_, toward_, normal_;
  double foot_ = 0, height_ = 0;  // point light; height is infinite for a directional one
  double cosine_ = 0, sine_ = 0;  // directional light
  bool directional_ = false, degenerate_ = false;
  Side before_, behind_;  // beyond the lines from the ray's two ends to the light
};

}  // namespace airlight
