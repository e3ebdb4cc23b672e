#pragma once

#include "common/algorithms/field.h"
#include "common/algorithms/view.h"

namespace airlight {

// The nearest triangle on each pixel's ray. A triangle covers the pixels whose centre lies in its projection with vertices
// rounded to 1/256 pixel (as GL rasterises; top-left rule); distance and normal are then those of the exact, unrounded
// triangle (ray_triangle() in common/formulas/triangle.h). Triangles are two-sided.
struct SurfaceVisibility {
  Buffer positions;  // float[3] a vertex, relative to the camera
  Buffer normals;    // float[3] a vertex, unit length
  Buffer triangles;  // uint32[4] a triangle: three vertices and the index of its material
  View view;

  Image distance;  // r32f: along the ray [m]; 1e30 where nothing is hit
  Image normal;    // rgb32f: interpolated, unit length, turned to the viewer; 0 where nothing is hit
  Image material;  // r32f: index; -1 where nothing is hit
  // rgb32f, optional, of at most 2^24 - 1 triangles: the triangle's number plus one, negative where `normal` is turned
  // (seen_side()); the weights of its second and third corner. 0 where nothing is hit.
  Image corners;

  static constexpr std::string_view name = "surface_visibility";
  static constexpr Domain domain = Domain::screen;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("positions", "m"), s.positions);
    v(in("normals"), s.normals);
    v(in("triangles"), s.triangles);
    v(knob("view"), s.view);
    v(out("distance", "m"), s.distance);
    v(out("normal"), s.normal);
    v(out("material"), s.material);
    v(out("corners"), s.corners);
  }
};

}  // namespace airlight
