// Mean optical depth of Gaussians. Included after cpu/simd.h and cpu/pixel_rays.h, anew for every target.
#if defined(AIRLIGHT_CPU_GAUSSIAN_MEAN_DEPTH_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AIRLIGHT_CPU_GAUSSIAN_MEAN_DEPTH_H
#undef AIRLIGHT_CPU_GAUSSIAN_MEAN_DEPTH_H
#else
#define AIRLIGHT_CPU_GAUSSIAN_MEAN_DEPTH_H
#endif

#include <vector>

#include "common/algorithms/medium.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

// Over all directions from a place.
HWY_INLINE Real gaussian_mean_depth(const std::vector<GaussianDensity>& gaussians, const Real3& place) {
  Real depth = 0.0;
  for (const GaussianDensity& g : gaussians) {
    const float in_radii = 1 / g.radius;
    const Real3 e{(g.center.x - place.x) * in_radii, (g.center.y - place.y) * in_radii, (g.center.z - place.z) * in_radii};
    depth = fma(average_gaussian_depth(dot(e, e)), g.extinction * g.radius, depth);
  }
  return depth;
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
