#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/environment_light.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>

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

static void environment_light(const EnvironmentLight& a, const TileView& view, std::span<const float> shininess) {
  const float* through = view.plane(a.transmittance);
  const float* tables = view.floats(a.tables);
  const std::vector<float> brdf(a.brdf.begin(), a.brdf.end());
  const auto brdfs = static_cast<std::size_t>(a.brdf.empty() ? 0 : *std::max_element(a.brdf.begin(), a.brdf.end()) + 1);
  const float* image = tables + environment_image_at(shininess.size(), brdfs);
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
      LaneLobes lobes(tables, shininess, surface);
      const auto lessen = [&](const Image& hidden, Real* radiance) HWY_ATTR {
        for (int c = 0; c < 3 && hidden; ++c) radiance[c] = max(radiance[c] - load(view.plane(hidden, c) + i), 0.0);
      };
      lessen(a.hidden_diffuse, lobes.diffuse);
      lessen(a.hidden_specular, lobes.specular);
      const Real attenuation = a.mean_depth ? transmittance(load(view.plane(a.mean_depth) + i)) : Real(1.0);
      Real reflected[3];
      for (int c = 0; c < 3; ++c) reflected[c] = fma(m.diffuse[c], lobes.diffuse[c], m.specular[c] * lobes.specular[c]);
      for (std::size_t b = 0; b < brdfs; ++b) {
        const Real number = static_cast<float>(b), tabulated = lane_brdf(brdf, surface.index);
        const Mask mine = hit && (tabulated >= number) && (tabulated <= number);
        if (!any_lane(mine)) continue;
        const Real3 &n = surface.normal, &v = surface.viewer;
        Real sent[3];
        brdf_environment(tables + environment_harmonics_at(shininess.size()), tables + brdf_lobes_at(shininess.size(), b), n.x,
                         n.y, n.z, v.x, v.y, v.z, sent[0], sent[1], sent[2]);
        lessen(a.hidden_specular, sent);
        for (int c = 0; c < 3; ++c) reflected[c] = select(mine, sent[c], reflected[c]);
      }
      for (int c = 0; c < 3; ++c) light[c] = select(hit, reflected[c] * attenuation, light[c]);
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
  thread_local std::vector<float> shininess;  // kept for its memory alone
  find_shininess(a.materials, shininess);
  entry(HWY_DISPATCH_TABLE(environment_light), simd)(a, view, shininess);
}

}  // namespace airlight
#endif
