#pragma once

#include "common/algorithms/field.h"
#include "common/image.h"

namespace airlight {

// Airlight of every pixel from that of every `stride`-th one (Subsample), after section 5.4 of Zhou et al. 2007, who interpolate
// bilinearly, and take the neighbour of the most similar depth where depths differ. Here a pixel is served by the four samples
// around it in the first of these ways whose error, by an estimate, is at most `tolerance` of the airlight there:
// * the rays of all five end on one smooth surface, or nowhere: bilinear, and the second difference as well. What that adds is
//   taken for the error;
// * the pixel's ray ends between the ends of theirs: bilinear. Airlight grows with the length of a ray, so that the spread of the
//   samples is the error;
// * bilinear weights times a weight for how near the ends are, of those samples that are near: their spread is the error.
// Else, at edges of surfaces and of shafts of light, it is not served: all channels are -1, and whoever reads them has that
// pixel computed (GaussianAirlight::known). The formulas are in common/formulas/upsample.h.
//
// A pixel depends on samples up to two strides away and on where it stands in the image alone: a part of the image that begins at
// a multiple of the stride, with so much around it, gives the same.
struct DepthAwareUpsample {
  Image distance;           // r32f [m], 1e30 on a miss
  Image sampled_distance;   // r32f [m], subsampled
  Image sampled_airlight;   // rgb32f, of the same extent
  Image sampled_per_light;  // rgb32f, a layer a light, of the same extent; with per_light
  int stride = 2;           // 2 or 4
  float tolerance = 0.01F;  // > 0

  Image airlight;   // rgb32f, at least 0; -1 where it is not known
  Image per_light;  // rgb32f, a layer a light; optional

  static constexpr std::string_view name = "depth_aware_upsample";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("sampled_distance", "m"), s.sampled_distance);
    v(in("sampled_airlight", "W/m^2/sr"), s.sampled_airlight);
    v(in("sampled_per_light", "W/m^2/sr"), s.sampled_per_light);
    v(knob("stride"), s.stride);
    v(knob("tolerance"), s.tolerance);
    v(out("airlight", "W/m^2/sr"), s.airlight);
    v(out("per_light", "W/m^2/sr"), s.per_light);
  }
};

}  // namespace airlight
