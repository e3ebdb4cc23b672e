#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/view_transmittance.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

static void view_transmittance(const ViewTransmittance& a, const TileView& view) {
  const float* distance = view.plane(a.distance);
  float* out = view.plane(a.transmittance);
  float* depth = view.plane(a.optical_depth);
  for (int i = 0; i < tile_pixels; i += lanes) {
    const Real tau = optical_depth(ray_length(load(distance + i), a.sky_distance), a.extinction);
    store(transmittance(tau), out + i);
    if (depth) store(tau, depth + i);
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(view_transmittance);

void run_tile(const ViewTransmittance& a, const TileView& view, Simd simd) {
  entry(HWY_DISPATCH_TABLE(view_transmittance), simd)(a, view);
}

}  // namespace airlight
#endif
