#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/surface_shading.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/lane_surface.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

static void surface_shading(const SurfaceShading& a, const TileView& view) {
  const float* through = view.plane(a.transmittance);
  bool glossy = false;
  for (const Material& m : a.materials) glossy |= m.specular.x > 0 || m.specular.y > 0 || m.specular.z > 0;
  const float* brdfs = a.brdfs ? view.floats(a.brdfs) : nullptr;
  const std::vector<float> brdf(a.brdf.begin(), a.brdf.end());

  for (int i = 0; i < tile_pixels; i += lanes) {
    const LaneSurface surface(a, view, i);
    const Mask hit = surface.hit;
    const Real t = load(through + i);
    Real indirect[3] = {0.0, 0.0, 0.0};
    if (a.indirect) {
      for (int c = 0; c < 3; ++c) indirect[c] = load(view.plane(a.indirect, c) + i);
    }
    Real direct[3] = {0.0, 0.0, 0.0}, ambient[3] = {0.0, 0.0, 0.0};
    if (any_lane(hit && t > 0.0)) {  // nothing is seen behind opaque fog
      const LaneMaterial& m = surface.material;
      const Real tabulated = brdfs ? lane_brdf(brdf, surface.index) : Real(-1.0);
      for (std::size_t k = 0; k < a.lights.size(); ++k) {
        const Light& light = a.lights[k];
        Real length, irradiance = 1.0;
        const Real3 l = toward_light(light, surface.place, length);
        if (!light.directional) irradiance = point_irradiance(length, light.radius, a.extinction);
        if (a.light_transmittance) {
          irradiance *= load(view.plane(a.light_transmittance, 0, static_cast<int>(k)) + i);
        }
        const Real cosine = dot(surface.normal, l);
        for (std::size_t b = 0; brdfs && b < a.brdf_at.size(); ++b) {
          const Real number = static_cast<float>(b);
          const Mask mine = hit && (tabulated >= number) && (tabulated <= number);
          if (!any_lane(mine)) continue;
          const Real3 &n = surface.normal, &v = surface.viewer;
          Real sent[3];
          brdf_reflection(brdfs + a.brdf_at[b], n.x, n.y, n.z, l.x, l.y, l.z, v.x, v.y, v.z, sent[0], sent[1], sent[2]);
          for (int c = 0; c < 3; ++c) direct[c] = select(mine, fma(sent[c] * irradiance, light.power[c], direct[c]), direct[c]);
        }
        if (brdfs) irradiance = select(tabulated >= 0.0, 0.0, irradiance);
        const Real diffuse = lambert(cosine) * irradiance;
        for (int c = 0; c < 3; ++c) direct[c] = fma(m.diffuse[c] * diffuse, light.power[c], direct[c]);
        if (glossy) {
          const Real specular =
              phong(cosine, unit_distance(surface.mirror.x, surface.mirror.y, surface.mirror.z, l.x, l.y, l.z), m.shininess) *
              irradiance;
          for (int c = 0; c < 3; ++c) direct[c] = fma(m.specular[c] * specular, light.power[c], direct[c]);
        }
      }
      for (int c = 0; c < 3; ++c) {
        direct[c] = select(hit, direct[c] * t, 0.0);
        ambient[c] = select(hit, m.diffuse[c] * a.ambient[c] * t, 0.0);
      }
    } else {
      view.skip(view.in_image(i, lanes));
    }
    for (int c = 0; c < 3; ++c) {
      Real all = select(hit, direct[c] + indirect[c] + ambient[c], t * a.background[c]);
      if (a.environment) all += load(view.plane(a.environment, c) + i);
      store(all, view.plane(a.surface, c) + i);
      if (a.surface_direct) store(direct[c], view.plane(a.surface_direct, c) + i);
      if (a.surface_ambient) store(ambient[c], view.plane(a.surface_ambient, c) + i);
    }
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(surface_shading);

void run_tile(const SurfaceShading& a, const TileView& view, Simd simd) {
  entry(HWY_DISPATCH_TABLE(surface_shading), simd)(a, view);
}

}  // namespace airlight
#endif
