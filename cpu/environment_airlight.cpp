#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/environment_airlight.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

static void environment_airlight(const EnvironmentAirlight& a, const TileView& view) {
  const float* distance = view.plane(a.distance);
  const float* depth = view.plane(a.optical_depth);
  const float* tables = view.floats(a.tables);
  for (int i = 0; i < tile_pixels; i += lanes) {
    const Real3 d = pixel_rays(a.view, view.tile, i);
    const Real tau = load(depth + i);
    const Real homogeneous = min(optical_depth(ray_length(load(distance + i), a.sky_distance), a.extinction), tau);
    const Real rest = tau - homogeneous;
    Real of_homogeneous, of_rest;
    environment_scattered(homogeneous, rest, of_homogeneous, of_rest);
    if (a.scattering == EnvironmentScattering::published) {
      const Real share = environment_scattered_published(tau) / max(tau, 1e-30);
      of_homogeneous = homogeneous * share;
      of_rest = rest * share;
    }
    Real gathered[3];
    environment_reflection(tables, d.x, d.y, d.z, gathered[0], gathered[1], gathered[2]);
    for (int c = 0; c < 3; ++c) {
      const Real albedo = fma(of_homogeneous, a.albedo[c], of_rest * a.gaussian_albedo[c]);
      store(fma(gathered[c], albedo, load(view.plane(a.scattered, c) + i)), view.plane(a.airlight, c) + i);
    }
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(environment_airlight);

void run_tile(const EnvironmentAirlight& a, const TileView& view, Simd simd) {
  entry(HWY_DISPATCH_TABLE(environment_airlight), simd)(a, view);
}

}  // namespace airlight
#endif
