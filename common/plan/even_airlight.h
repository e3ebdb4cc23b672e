// Fog whose airlight is the same along all rays of a length: nothing shines in it but suns, and it scatters to all sides alike.
#pragma once

#include <algorithm>

#include "common/algorithms/view.h"

namespace airlight {

// Whether rays that meet fog alone, all of which lights reach, have the same. Where Gaussians or a grid stand they may shade it.
template <class Airlight>
bool has_even_fog(const Airlight& a) {
  bool open = true;
  if constexpr (requires { a.gaussians; }) open = a.lights.empty() || (a.gaussians.empty() && !a.grid);
  if constexpr (requires { a.scattered; }) open = !a.scattered;
  return open && !a.per_light && (a.lights.empty() || a.phase.kind == PhaseKind::isotropic) &&
         std::all_of(a.lights.begin(), a.lights.end(), [](const Light& l) { return l.directional; });
}

// What such a ray has, of which others are told.
struct KnownRay {
  bool possible = false, known = false;
  float distance = 0;  // of the surface that it ends at
  float airlight[3] = {0, 0, 0}, transmittance = 1, optical_depth = 0;
};

}  // namespace airlight
