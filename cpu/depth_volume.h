// The optical depth toward a light from its volume, for a vector of lanes. Included after cpu/simd.h and cpu/pixel_rays.h, anew
// for every target.
#if defined(AIRLIGHT_CPU_DEPTH_VOLUME_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AIRLIGHT_CPU_DEPTH_VOLUME_H
#undef AIRLIGHT_CPU_DEPTH_VOLUME_H
#else
#define AIRLIGHT_CPU_DEPTH_VOLUME_H
#endif

#include "common/algorithms/depth_volume.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

HWY_INLINE Real depth_to_light(const DepthVolume& volume, table depths, const Real3& p) {
  const auto frame = [&](int axis) HWY_ATTR {
    const glm::vec4& row = volume.rows[axis];
    return fma(row.x, p.x, fma(row.y, p.y, fma(row.z, p.z, row.w)));
  };
  return depth_in_volume(depths, static_cast<int>(volume.kind), volume.halves ? 1 : 0, frame(0), frame(1), frame(2));
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
