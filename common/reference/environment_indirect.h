// An environment's light that scatters once on its way to surfaces, in double.
#pragma once

#include "common/reference/environment.h"
#include "common/reference/indirect_exact.h"
#include "common/reference/line.h"

namespace airlight {

// Radiance [W/m^2/sr] that the point sends to the camera's side of what the medium scatters toward it once of the environment's
// light, and its estimated error: over the half space in front of the triangle, as exact_indirect() does, of rays that end at the
// first surface and have no end where they meet none. On its way to a ray the light is attenuated by Gaussians and the grid, as
// it is given as it arrives through the homogeneous part, and hidden by nothing.
//
// Sums of fixed size: directions of equal weight about the normal and about the mirror direction, Gauss's nodes along each ray,
// patches of the sky. The error is the difference to a quarter of the directions and of the patches.
Integral exact_environment_indirect(const RelativeMedium&, const Visibility&, const EnvironmentLighting&, const SurfacePoint&);

}  // namespace airlight
