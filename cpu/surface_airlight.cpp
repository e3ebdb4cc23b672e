#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/surface_airlight.cpp"
#include <hwy/foreach_target.h>

#include "common/plan/surface_airlight_tables.h"
#include "common/plan/surface_psf.h"
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
    const Real seen = load(through + i);
    if (any_lane(hit && seen > 0.0)) {  // nothing is seen behind opaque fog
      const LaneMaterial& m = surface.material;
      const Real glossy = max(max(m.specular[0], m.specular[1]), m.specular[2]);
      const bool psf = a.scattering == SurfaceScattering::psf;
      const std::size_t floats = psf ? surface_psf_floats : surface_airlight_floats;
      for (std::size_t which = 0; which < a.lights.size(); ++which) {
        const Light& light = a.lights[which];
        Real length, of_fog = 0.0, fall_off = 1.0;
        const Real3 l = toward_light(light, surface.place, length);
        if (!light.directional) {
          const Real r = max(length, light.radius);
          of_fog = length * a.extinction;
          fall_off = 1.0 / (r * r);
        }
        // What once(table, axis) gives of the lobes about the normal and the mirror direction, as the material reflects it.
        const auto add = [&](auto&& once, const Real* albedo) HWY_ATTR {
          const Real diffuse = once(tables, surface.normal) * 0.31830988618379067;
          Real specular = 0.0;
          for (std::size_t k = 0; k < shininess.size(); ++k) {
            const Mask mine = hit && (glossy > 0.0) && (m.shininess >= shininess[k]) && (m.shininess <= shininess[k]);
            if (!any_lane(mine)) continue;
            specular = select(mine, once(tables + (k + 1) * floats, surface.mirror), specular);
          }
          for (int c = 0; c < 3; ++c)
            sum[c] = fma(fma(m.diffuse[c], diffuse, m.specular[c] * specular), light.power[c] * albedo[c], sum[c]);
        };
        const Real fog_albedo[3] = {a.albedo[0], a.albedo[1], a.albedo[2]};
        Real albedo[3] = {fog_albedo[0], fog_albedo[1], fog_albedo[2]}, rest = 0.0, lambda = of_fog;
        if (a.depth_toward_light) {
          rest = load(view.plane(a.depth_toward_light, 0, static_cast<int>(which)) + i);
          lambda = of_fog + rest;
          const Real share = rest / max(lambda, 1e-30);
          for (int c = 0; c < 3; ++c) albedo[c] = fma(share, a.rest_albedo[c] - albedo[c], albedo[c]);
        }
        if (psf) {
          add([&](const float* t, const Real3& axis)
                  HWY_ATTR { return surface_airlight_psf(t, lambda, dot(axis, l)) * fall_off; },
              albedo);
          continue;
        }
        if (!light.directional || a.depth_toward_light) {
          add([&](const float* t, const Real3& axis)
                  HWY_ATTR { return surface_airlight_point(t, lambda, half_angle_sine(axis, l)) * fall_off; },
              albedo);
        }
        if (light.directional && a.extinction > 0) {
          const Real attenuation = transmittance(rest);
          add([&](const float* t, const Real3& axis)
                  HWY_ATTR { return surface_airlight_directional(t, half_angle_sine(axis, l)) * attenuation; },
              fog_albedo);
        }
      }
      for (int c = 0; c < 3; ++c) sum[c] = select(hit, sum[c] * seen, 0.0);
    } else {
      view.skip(view.in_image(i, lanes));
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
  thread_local std::vector<float> shininess;  // kept for its memory alone
  find_shininess(a.materials, shininess);
  entry(HWY_DISPATCH_TABLE(surface_airlight), simd)(a, view, shininess);
}

}  // namespace airlight
#endif
