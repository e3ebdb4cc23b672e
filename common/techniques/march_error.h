// What steps along view rays leave out: the model by which goals choose them.
#pragma once

#include "common/scene/scene.h"

namespace airlight {

// A part of the medium that a way goes through.
struct UnevenPart {
  double length = 0;  // [m] of the longest way; 0: there is none
  double scale = 1;   // [m] over which its extinction changes

  // Relative error of n steps over it: the midpoint rule, and what it misses altogether where a step is longer than the scale.
  double left_by(double n) const;
  // Of look-ups between nodes so far apart [m], by the most opaque of the scenes that the model was tried on.
  double left_by_cells(double cell) const;
};
UnevenPart gaussians_part(const Scene&);
UnevenPart grid_part(const Scene&);

// Relative error of n steps in each stretch of medium; how steps lie to lamps decides, so its numbers are fitted to the sweeps of
// docs/RESULTS.md by a factor of up to ten on the safe side:
// * 0.25 x^2, x the largest optical depth of a step before the farthest lamp (graded_step()), were it everywhere as dense as at the
//   camera,
// * an anisotropic phase function near a lamp: 0.4 / steps, its covariance with the fade in the one step that holds the lamp,
// * Gaussians and grid: UnevenPart.
double left_by_steps(const Scene&, double n);

}  // namespace airlight
