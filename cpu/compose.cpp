#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/compose.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

static void compose(const Compose& a, const TileView& view) {
  for (int channel = 0; channel < 3; ++channel) {
    const float* surface = view.plane(a.surface, channel);
    const float* airlight = view.plane(a.airlight, channel);
    float* beauty = view.plane(a.beauty, channel);
    for (int i = 0; i < tile_pixels; i += lanes) store(load(surface + i) + load(airlight + i), beauty + i);
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(compose);

void run_tile(const Compose& a, const TileView& view, Simd simd) { entry(HWY_DISPATCH_TABLE(compose), simd)(a, view); }

}  // namespace airlight
#endif
