#pragma once

#include "common/algorithms/field.h"
#include "common/image.h"

namespace airlight {

// beauty = surface + airlight, one float addition a channel.
struct Compose {
  Image surface, airlight;  // rgb32f [W/m^2/sr]
  Image beauty;             // rgb32f [W/m^2/sr]

  static constexpr std::string_view name = "compose";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("surface", "W/m^2/sr"), s.surface);
    v(in("airlight", "W/m^2/sr"), s.airlight);
    v(out("beauty", "W/m^2/sr"), s.beauty);
  }
};

}  // namespace airlight
