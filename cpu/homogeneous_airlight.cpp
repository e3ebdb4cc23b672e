#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/homogeneous_airlight.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/known_ray.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

static void homogeneous_airlight(const HomogeneousAirlight& a, const TileView& view) {
  const float* distance = view.plane(a.distance);
  const float* tables = a.tables ? view.floats(a.tables) : nullptr;
  KnownRay known;
  known.possible = has_even_fog(a);
  for (int i = 0; i < tile_pixels; i += lanes) {
    if (store_known(a, view, known, distance, i)) continue;
    const Real length = ray_length(load(distance + i), a.sky_distance);
    const Real tau = optical_depth(length, a.extinction);
    const Real3 d = pixel_rays(a.view, view.tile, i);
    const Real source = opacity(tau);
    const Real emitting = attenuated_length(length, a.extinction, tau);
    Real sum[3];
    for (int c = 0; c < 3; ++c) sum[c] = fma(source, a.ambient[c], emitting * a.emission[c]);
    for (std::size_t k = 0; k < a.lights.size(); ++k) {
      const Light& light = a.lights[k];
      Real once = 0.0;
      if (a.scattered) {
        once = load(view.plane(a.scattered, 0, static_cast<int>(k)) + i);
      } else if (a.extinction > 0) {
        once = airlight_of(light, d, tables, a.phase, a.extinction, 0.0, length);
      }
      for (int c = 0; c < 3; ++c) {
        const Real scattered = once * (light.power[c] * a.albedo[c]);
        if (a.per_light) store(scattered, view.plane(a.per_light, c, static_cast<int>(k)) + i);
        sum[c] += scattered;
      }
    }
    for (int c = 0; c < 3; ++c) store(sum[c], view.plane(a.airlight, c) + i);
    keep_known(a, view, known, distance, i);
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(homogeneous_airlight);

void run_tile(const HomogeneousAirlight& a, const TileView& view, Simd simd) {
  entry(HWY_DISPATCH_TABLE(homogeneous_airlight), simd)(a, view);
}

}  // namespace airlight
#endif
