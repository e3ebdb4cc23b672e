#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/surface_airlight.cpp"
#include <hwy/foreach_target.h>

#include "common/plan/surface_airlight_tables.h"
#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/lane_surface.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

// Sine of half the angle between two unit vectors.
static HWY_INLINE Real half_angle_sine(const Real3& a, const Real3& b) {
  return min(sqrt(unit_distance(a.x, a.y, a.z, b.x, b.y, b.z) * 0.5), 1.0);
}

static void surface_airlight(const SurfaceAirlight& a, const TileView& view, std::span<const float> shininess) {
  const float* through = view.plane(a.transmittance);
  const float* tables = view.floats(a.tables);
  for (int i = 0; i < tile_pixels; i += lanes) {
    const LaneSurface surface(a, view, i);
    const Mask hit = surface.hit;
    Real sum[3] = {0.0, 0.0, 0.0};
    if (any_lane(hit)) {
      const LaneMaterial& m = surface.material;
      const Real glossy = max(max(m.specular[0], m.specular[1]), m.specular[2]);
      for (const Light& light : a.lights) {
        Real length, lambda = 0.0, fall_off = 1.0;
        const Real3 l = toward_light(light, surface.place, length);
        if (!light.directional) {
          const Real r = max(length, light.radius);
          lambda = length * a.extinction;
          fall_off = 1.0 / (r * r);
        }
        const auto once = [&](const float* t, Real s) HWY_ATTR {
          return light.directional ? surface_airlight_directional(t, s) : surface_airlight_point(t, lambda, s) * fall_off;
        };
        const Real diffuse = once(tables, half_angle_sine(surface.normal, l)) * 0.31830988618379067;
        Real specular = 0.0;
        const Real s = half_angle_sine(surface.mirror, l);
        for (std::size_t k = 0; k < shininess.size(); ++k) {
          const Mask mine = hit && (glossy > 0.0) && (m.shininess >= shininess[k]) && (m.shininess <= shininess[k]);
          if (!any_lane(mine)) continue;
          specular = select(mine, once(tables + (k + 1) * surface_airlight_floats, s), specular);
        }
        for (int c = 0; c < 3; ++c) {
          sum[c] = fma(fma(m.diffuse[c], diffuse, m.specular[c] * specular), light.power[c] * a.albedo[c], sum[c]);
        }
      }
      const Real seen = load(through + i);
      for (int c = 0; c < 3; ++c) sum[c] = select(hit, sum[c] * seen, 0.0);
    }
    for (int c = 0; c < 3; ++c) store(sum[c], view.plane(a.indirect, c) + i);
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(surface_airlight);

void run_tile(const SurfaceAirlight& a, const TileView& view, Simd simd) {
  const std::vector<float> shininess = shininess_of(a.materials);
  entry(HWY_DISPATCH_TABLE(surface_airlight), simd)(a, view, shininess);
}

}  // namespace airlight
#endif
