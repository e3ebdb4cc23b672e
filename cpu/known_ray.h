// Rays through fog alone that have what another one has (common/plan/even_airlight.h). Included after cpu/pixel_rays.h, anew for
// every target.
#if defined(AIRLIGHT_CPU_KNOWN_RAY_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AIRLIGHT_CPU_KNOWN_RAY_H
#undef AIRLIGHT_CPU_KNOWN_RAY_H
#else
#define AIRLIGHT_CPU_KNOWN_RAY_H
#endif

#include "common/plan/even_airlight.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

// Whether the rays of pixels i .. i + lanes - 1 are all as long as each other.
HWY_INLINE bool as_long(const float* distance, int i) {
  const Real all = load(distance + i), first = distance[i];
  return !any_lane(all < first) && !any_lane(all > first);
}
// Where these are as long as a ray that is known, and meet no more than it does, stores what it has. Else false.
template <class Airlight>
HWY_INLINE bool store_known(const Airlight& a, const TileView& view, const KnownRay& ray, const float* distance, int i) {
  if (!ray.known || !(distance[i] >= ray.distance && distance[i] <= ray.distance) || !as_long(distance, i)) return false;
  for (int c = 0; c < 3; ++c) store(ray.airlight[c], view.plane(a.airlight, c) + i);
  if constexpr (requires { a.transmittance; }) {
    store(ray.transmittance, view.plane(a.transmittance) + i);
    if (a.optical_depth) store(ray.optical_depth, view.plane(a.optical_depth) + i);
  }
  view.skip(view.in_image(i, lanes));
  return true;
}
// After these have been made.
template <class Airlight>
HWY_INLINE void keep_known(const Airlight& a, const TileView& view, KnownRay& ray, const float* distance, int i) {
  if (!ray.possible || !as_long(distance, i)) return;
  ray.known = true;
  ray.distance = distance[i];
  for (int c = 0; c < 3; ++c) ray.airlight[c] = view.plane(a.airlight, c)[i];
  if constexpr (requires { a.transmittance; }) {
    ray.transmittance = view.plane(a.transmittance)[i];
    if (a.optical_depth) ray.optical_depth = view.plane(a.optical_depth)[i];
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
