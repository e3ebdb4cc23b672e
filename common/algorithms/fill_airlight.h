#pragma once

#include "common/algorithms/field.h"
#include "common/image.h"

namespace airlight {

// Puts a picture together: pixels that DepthAwareUpsample has served, and the remaining ones, which were computed.
struct FillAirlight {
  Image remaining;                // r32f [m], as DepthAwareUpsample's
  Image upsampled;                // rgb32f, its airlight
  Image upsampled_per_light;      // rgb32f, a layer a light; with per_light
  Image upsampled_transmittance;  // r32f
  Image computed;                 // rgb32f, where `remaining` is above 0
  Image computed_per_light;       // rgb32f, a layer a light; with per_light
  Image computed_transmittance;   // r32f

  Image airlight;       // rgb32f
  Image per_light;      // rgb32f, a layer a light; optional
  Image transmittance;  // r32f, 0..1

  static constexpr std::string_view name = "fill_airlight";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("remaining", "m"), s.remaining);
    v(in("upsampled", "W/m^2/sr"), s.upsampled);
    v(in("upsampled_per_light", "W/m^2/sr"), s.upsampled_per_light);
    v(in("upsampled_transmittance"), s.upsampled_transmittance);
    v(in("computed", "W/m^2/sr"), s.computed);
    v(in("computed_per_light", "W/m^2/sr"), s.computed_per_light);
    v(in("computed_transmittance"), s.computed_transmittance);
    v(out("airlight", "W/m^2/sr"), s.airlight);
    v(out("per_light", "W/m^2/sr"), s.per_light);
    v(out("transmittance"), s.transmittance);
  }
};

}  // namespace airlight
