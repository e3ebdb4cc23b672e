#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/environment_indirect.cpp"
#include <hwy/foreach_target.h>

#include "common/algorithms/environment_light.h"
#include "common/plan/surface_airlight_tables.h"
#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/lane_surface.h"
//
#include "cpu/environment_lobes.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

static void environment_indirect(const EnvironmentIndirect& a, const TileView& view, std::span<const float> shininess) {
  const float* through = view.plane(a.transmittance);
  const float* tables = view.floats(a.tables);
  for (int i = 0; i < tile_pixels; i += lanes) {
    const LaneSurface surface(a, view, i);
    const Mask hit = surface.hit;
    Real sum[3] = {0.0, 0.0, 0.0};
    if (any_lane(hit)) {
      const LaneMaterial& m = surface.material;
      const LaneLobes lobes(tables, shininess, surface);
      const Real depth = a.mean_depth ? load(view.plane(a.mean_depth) + i) : Real(0.0);
      Real of_homogeneous, of_rest;
      environment_scattered_to_surface(depth, of_homogeneous, of_rest);
      if (a.scattering == EnvironmentScattering::published) {
        of_homogeneous = 0.0;
        of_rest = environment_scattered_published(depth);
      }
      const Real seen = load(through + i);
      for (int c = 0; c < 3; ++c) {
        const Real albedo = fma(of_homogeneous, a.albedo[c], of_rest * a.gaussian_albedo[c]) * seen;
        sum[c] = select(hit, fma(m.diffuse[c], lobes.diffuse[c], m.specular[c] * lobes.specular[c]) * albedo, 0.0);
      }
    } else {
      view.skip(view.in_image(i, lanes));
    }
    for (int c = 0; c < 3; ++c) {
      if (a.scattered) sum[c] += load(view.plane(a.scattered, c) + i);
      store(sum[c], view.plane(a.indirect, c) + i);
    }
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(environment_indirect);

void run_tile(const EnvironmentIndirect& a, const TileView& view, Simd simd) {
  thread_local std::vector<float> shininess;  // kept for its memory alone
  find_shininess(a.materials, shininess);
  entry(HWY_DISPATCH_TABLE(environment_indirect), simd)(a, view, shininess);
}

}  // namespace airlight
#endif
