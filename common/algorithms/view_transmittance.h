#pragma once

#include "common/algorithms/field.h"
#include "common/algorithms/view.h"

namespace airlight {

// exp(-T(v, P)) of the homogeneous medium along each pixel's ray, to the surface or, where it hits nothing, over sky_distance.
struct ViewTransmittance {
  Image distance;              // r32f [m], 1e30 on a miss
  float extinction = 0;        // [1/m]
  float sky_distance = 1e30F;  // [m]; 1e30 and above stand for infinity

  Image transmittance;  // r32f, 0..1
  Image optical_depth;  // r32f, optional; 1e30 where it is infinite

  static constexpr std::string_view name = "view_transmittance";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(knob("extinction", "1/m"), s.extinction);
    v(knob("sky_distance", "m"), s.sky_distance);
    v(out("transmittance"), s.transmittance);
    v(out("optical_depth"), s.optical_depth);
  }
};

}  // namespace airlight
