#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/environment_light.cpp"
#include <hwy/foreach_target.h>

#include "common/plan/surface_airlight_tables.h"
#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/lane_surface.h"
#include "cpu/mean_depth.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

static void environment_light(const EnvironmentLight& a, const TileView& view, std::span<const float> shininess) {
  const float* through = view.plane(a.transmittance);
  const float* tables = view.floats(a.tables);
  const float* image = tables + environment_image_at(shininess.size());
  for (int i = 0; i < tile_pixels; i += lanes) {
    const LaneSurface surface(a, view, i);
    const Mask hit = surface.hit;
    Real light[3] = {0.0, 0.0, 0.0};
    if (any_lane(!hit)) {
      const Real3 d = pixel_rays(a.view, view.tile, i);
      Real turns, polar;
      environment_place(d.x, d.y, d.z, turns, polar);
      for (int c = 0; c < 3; ++c) light[c] = environment_value(image, c, turns, polar);
    }
    if (any_lane(hit)) {
      const LaneMaterial& m = surface.material;
      const auto lobe = [&](const float* t, const Real3& about, Real* radiance) HWY_ATTR {
        environment_reflection(t + environment_share_floats, about.x, about.y, about.z, radiance[0], radiance[1], radiance[2]);
      };
      Real diffuse[3], specular[3] = {0.0, 0.0, 0.0};
      lobe(tables, surface.normal, diffuse);
      const Real glossy = max(max(m.specular[0], m.specular[1]), m.specular[2]);
      const Real level = dot(surface.normal, surface.mirror);
      for (std::size_t k = 0; k < shininess.size(); ++k) {
        const Mask mine = hit && (glossy > 0.0) && (m.shininess >= shininess[k]) && (m.shininess <= shininess[k]);
        if (!any_lane(mine)) continue;
        const float* t = tables + (k + 1) * environment_lobe_floats;
        const Real share = environment_share(t, level);
        Real radiance[3];
        lobe(t, surface.mirror, radiance);
        for (int c = 0; c < 3; ++c) specular[c] = select(mine, radiance[c] * share, specular[c]);
      }
      const Real attenuation = transmittance(mean_depth(a.gaussians, surface.place));
      for (int c = 0; c < 3; ++c) {
        light[c] = select(hit, fma(m.diffuse[c], diffuse[c], m.specular[c] * specular[c]) * attenuation, light[c]);
      }
    }
    const Real seen = load(through + i);
    for (int c = 0; c < 3; ++c) store(light[c] * seen, view.plane(a.environment, c) + i);
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(environment_light);

void run_tile(const EnvironmentLight& a, const TileView& view, Simd simd) {
  const std::vector<float> shininess = shininess_of(a.materials);
  entry(HWY_DISPATCH_TABLE(environment_light), simd)(a, view, shininess);
}

}  // namespace airlight
#endif
