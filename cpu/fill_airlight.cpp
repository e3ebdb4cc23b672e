#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/fill_airlight.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

static void fill_airlight(const FillAirlight& a, const TileView& view) {
  const float* remaining = view.plane(a.remaining);
  const auto fill = [&](const Image& to, const Image& upsampled, const Image& computed) HWY_ATTR {
    for (int plane = 0; plane < channels(to.format) * to.layers; ++plane) {  // layers lie behind each other
      float* out = view.plane(to, plane);
      const float *one = view.plane(upsampled, plane), *other = view.plane(computed, plane);
      for (int i = 0; i < tile_pixels; i += lanes)
        store(select(load(remaining + i) > 0.0, load(other + i), load(one + i)), out + i);
    }
  };
  fill(a.airlight, a.upsampled, a.computed);
  fill(a.transmittance, a.upsampled_transmittance, a.computed_transmittance);
  if (a.per_light) fill(a.per_light, a.upsampled_per_light, a.computed_per_light);
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(fill_airlight);

void run_tile(const FillAirlight& a, const TileView& view, Simd simd) { entry(HWY_DISPATCH_TABLE(fill_airlight), simd)(a, view); }

}  // namespace airlight
#endif
