#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/light_march.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/medium.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

static void light_march(const LightMarch& a, const TileView& view) {
  const float* distance = view.plane(a.distance);
  const MediumLookup medium(a, view);
  for (int i = 0; i < tile_pixels; i += lanes) {
    const Real depth = load(distance + i);
    const Mask hit = depth < 1e30;
    if (!any_lane(hit)) view.skip(view.in_image(i, lanes));
    for (std::size_t k = 0; k < a.lights.size(); ++k) {
      Real through = 1.0, toward = 0.0;
      if (any_lane(hit)) {
        const Real3 p = along({0.0, 0.0, 0.0}, pixel_rays(a.view, view.tile, i), select(hit, depth, 0.0));
        toward = select(hit, depth_to(medium, k, a.lights[k], p, hit), 0.0);
        through = transmittance(toward);
      }
      if (a.depth_toward_light) store(toward, view.plane(a.depth_toward_light, 0, static_cast<int>(k)) + i);
      if (a.lit) through *= load(view.plane(a.lit, 0, static_cast<int>(k)) + i);
      store(through, view.plane(a.light_transmittance, 0, static_cast<int>(k)) + i);
    }
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(light_march);

void run_tile(const LightMarch& a, const TileView& view, Simd simd) { entry(HWY_DISPATCH_TABLE(light_march), simd)(a, view); }

}  // namespace airlight
#endif
