#pragma once

#include "common/algorithms/field.h"
#include "common/image.h"

namespace airlight {

// Airlight and transmittance of every pixel from those of every `stride`-th one (Subsample), after section 5.4 of Zhou et al.
// 2007, who interpolate bilinearly, and take the neighbour of the most similar depth where depths differ. Here a pixel is served
// by the four samples around it in the first of these ways whose error, by an estimate, is at most `tolerance` of what is there:
// * the rays of all five end on one smooth surface, or nowhere: bilinear, and the second difference as well, of the side where
//   it is less. What the mean of both sides' would add is taken for the error;
// * the pixel's ray ends between the ends of theirs: bilinear. Airlight grows with the length of a ray, so that the spread of the
//   samples is the error, and what second differences would add: they tell of a peak between samples that are the same;
// * bilinear weights times a weight for how near the ends are, of those samples that are near. Their spread is the error, and
// that. Else, at edges of surfaces behind which there is more airlight and of shafts of light, and near lamps, it is not served,
// and has to be computed: `remaining` tells which. What is narrower than the stride and meets no sample is not seen.
//
// Where all samples are the same, so is what is between them, in every bit. A pixel depends on samples up to two strides away and
// on where it stands in the image alone: a part of the image that begins at a multiple of the stride, with so much around it,
// gives the same. The formulas are in common/formulas/upsample.h.
struct DepthAwareUpsample {
  Image distance;               // r32f [m], 1e30 on a miss
  Image sampled_distance;       // r32f [m], subsampled
  Image sampled_airlight;       // rgb32f, of the same extent
  Image sampled_per_light;      // rgb32f, a layer a light, of the same extent; with per_light
  Image sampled_transmittance;  // r32f, of the same extent
  int stride = 2;               // 2 or 4
  float tolerance = 0.01F;      // > 0

  Image remaining;      // r32f [m]: the distance where the pixel is not served, else 0
  Image airlight;       // rgb32f, at least 0; 0 where the pixel is not served
  Image per_light;      // rgb32f, a layer a light; optional
  Image transmittance;  // r32f, 0..1; 0 where the pixel is not served

  static constexpr std::string_view name = "depth_aware_upsample";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("distance", "m"), s.distance);
    v(in("sampled_distance", "m"), s.sampled_distance);
    v(in("sampled_airlight", "W/m^2/sr"), s.sampled_airlight);
    v(in("sampled_per_light", "W/m^2/sr"), s.sampled_per_light);
    v(in("sampled_transmittance"), s.sampled_transmittance);
    v(knob("stride"), s.stride);
    v(knob("tolerance"), s.tolerance);
    v(out("remaining", "m"), s.remaining);
    v(out("airlight", "W/m^2/sr"), s.airlight);
    v(out("per_light", "W/m^2/sr"), s.per_light);
    v(out("transmittance"), s.transmittance);
  }
};

}  // namespace airlight
