#pragma once

#include <cstdint>
#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/view.h"

namespace airlight {

// What the buffer ShadowPlanes::volumes holds, made by common/plan/shadow_volumes.h: one ShadowLight a light, in the order of
// `lights`, then every ShadowEdge. Positions are relative to the camera [m].
struct ShadowLight {
  double vector[3];       // position of a point light, unit direction toward a directional one
  double point;           // 1 for a point light, 0 for a directional one: (vector, point) is the light in homogeneous coordinates
  std::int64_t first;     // of its edges, counted from the first edge of the buffer
  std::int64_t count;     // of its edges
  std::int64_t covering;  // how many triangles stand between the camera and the light: the count that every view ray starts from
};
// A silhouette edge. Extruded away from the light to infinity it is a shadow plane; who crosses it toward the left of a -> b, as
// seen from the light, has `multiplicity` more triangles between himself and the light than before.
struct ShadowEdge {
  double a[3], b[3];
  std::int32_t multiplicity;  // not 0, magnitude at most shadow_multiplicity
  std::int32_t unused;
};
constexpr std::int32_t shadow_multiplicity = 1 << 16;

// In which order a ray meets the planes that it crosses.
//
// exact: by distance, ray by ray.
//
// published: that of Biri et al. 2006, the same for all rays: the planes as wholes, back to front, which is the order of the
// edges in `volumes`. As printed (IV-A, steps 3 to 5, and IV-E): a pixel's stencil begins as the number of shadows that its
// surface lies in; where that is 0, the airlight from the camera to the surface is added. Then plane by plane, where it lies
// before the surface: one that faces the camera with its lit side adds the airlight from the camera to itself if it takes the
// stencil from 1 to 0, the others subtract it if they take it from 0 to 1. It is right where no two planes interleave that a ray
// crosses. Where they do, parts of rays are counted that are dark, or not counted or counted twice that are lit, and a sum may be
// negative. What the paper leaves open is decided thus:
//  * by what a plane, which is infinite, is sorted (IV-D says "back to front" alone): see back_to_front();
//  * what a stencil does below 0, which such an order can ask for: it counts on, as a wrapping one does, so that it ends right;
//  * a camera in shadow (IV-E names a "different strategy"): the first stencil is the true count, ShadowLight::covering included;
//  * meshes that are not closed (IV-B wants closed ones): a plane of multiplicity m stands for m planes in the same place, and
//    of these counts the one that takes the stencil across 0 and 1. Closed meshes have 2 and -2 alone, which is as 1 and -1.
// The airlight is ours, from the tables, and sums are floats, not clamped: eq. 7 and its shader have misprints.
enum class ShadowOrder { exact, published };

// Which parts of each pixel's ray each light reaches, from the shadow planes that the ray crosses before it ends: single
// scattering on these parts, and whether the surface at its end is lit (Biri et al. 2006, III-D and IV). The end of a lit part is
// where the ray crosses a plane, computed from the plane: no sampling.
struct ShadowPlanes {
  Image distance;  // r32f [m], 1e30 on a miss
  Buffer volumes;  // ShadowLight and ShadowEdge
  Buffer tables;   // as in HomogeneousAirlight; needed by point lights in a medium where `scattered` is wanted
  std::vector<Light> lights;
  View view;
  Phase phase;
  ShadowOrder order = ShadowOrder::exact;
  float extinction = 0;        // [1/m]
  float sky_distance = 1e30F;  // [m]; 1e30 and above stand for infinity

  Image scattered;            // r32f, a layer a light, per unit of its power and of albedo [1/m^2, directional 1]; optional
  Image light_transmittance;  // r32f, a layer a light: 1 where the ray's end is lit, 0 in shadow; optional

  static constexpr std::string_view name = "shadow_planes";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("volumes"), s.volumes);
    v(in("tables"), s.tables);
    v(knob("lights"), s.lights);
    v(knob("view"), s.view);
    v(knob("phase"), s.phase);
    v(knob("order"), s.order);
    v(knob("extinction", "1/m"), s.extinction);
    v(knob("sky_distance", "m"), s.sky_distance);
    v(out("scattered"), s.scattered);
    v(out("light_transmittance"), s.light_transmittance);
  }
};

}  // namespace airlight
