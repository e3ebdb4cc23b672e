// Particles and lines of an illumination network, for a vector of lanes. Included after cpu/simd.h and cpu/pixel_rays.h, anew for
// every target.
#if defined(AIRLIGHT_CPU_NETWORK_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AIRLIGHT_CPU_NETWORK_H
#undef AIRLIGHT_CPU_NETWORK_H
#else
#define AIRLIGHT_CPU_NETWORK_H
#endif

#include <cmath>

#include "common/algorithms/network.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

// Unit direction of a line.
HWY_INLINE Real3 line_direction_of(const std::int32_t* line) {
  const std::int32_t* w = line + line_direction;
  const Real3 d{static_cast<float>(w[0]), static_cast<float>(w[1]), static_cast<float>(w[2])};
  const Real scale = 1.0 / sqrt(dot(d, d));
  return {d.x * scale, d.y * scale, d.z * scale};
}

// Of particles v .. v + lanes - 1, of which the last may be beyond the end: the last one's then.
struct ParticleLanes {
  const float* planes;
  int count, v;

  HWY_INLINE Real plane(int k) const {
    const float* p = planes + static_cast<std::ptrdiff_t>(k) * count;
    if (v + lanes <= count) return load(p + v);
    HWY_ALIGN float values[16];
    for (int i = 0; i < lanes; ++i) values[i] = p[v + i < count ? v + i : count - 1];
    return load(values);
  }
  HWY_INLINE Real3 place(float unit) const {
    return {plane(particle_place) * unit, plane(particle_place + 1) * unit, plane(particle_place + 2) * unit};
  }
};

// Stores three channels of those particles as rgb and an unused float each.
HWY_INLINE void store_rgb(const Real (&rgb)[3], int count, int v, float* to) {
  HWY_ALIGN float values[3][16];
  for (int c = 0; c < 3; ++c) store(rgb[c], values[c]);
  for (int i = 0; i < lanes && v + i < count; ++i) {
    float* one = to + 4 * static_cast<std::ptrdiff_t>(v + i);
    for (int c = 0; c < 3; ++c) one[c] = values[c][i];
    one[3] = 0;
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
