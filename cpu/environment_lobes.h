// What Lambert's lobe and that of each lane's material reflect of an environment. Included after cpu/simd.h and
// cpu/lane_surface.h, anew for every target.
#if defined(AIRLIGHT_CPU_ENVIRONMENT_LOBES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AIRLIGHT_CPU_ENVIRONMENT_LOBES_H
#undef AIRLIGHT_CPU_ENVIRONMENT_LOBES_H
#else
#define AIRLIGHT_CPU_ENVIRONMENT_LOBES_H
#endif

#include <span>

#include "common/algorithms/environment_light.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

// Radiance [W/m^2/sr] of white surfaces, by the tables of EnvironmentLight; specular is 0 where the material has no lobe.
struct LaneLobes {
  Real diffuse[3], specular[3];

  HWY_INLINE LaneLobes(const float* tables, std::span<const float> shininess, const LaneSurface& surface) {
    const auto reflect = [](const float* t, const Real3& about, Real* radiance) HWY_ATTR {
      environment_reflection(t + environment_share_floats, about.x, about.y, about.z, radiance[0], radiance[1], radiance[2]);
    };
    const LaneMaterial& m = surface.material;
    reflect(tables, surface.normal, diffuse);
    for (Real& s : specular) s = 0.0;
    const Real glossy = max(max(m.specular[0], m.specular[1]), m.specular[2]);
    const Real level = dot(surface.normal, surface.mirror);
    for (std::size_t k = 0; k < shininess.size(); ++k) {
      const Mask mine = surface.hit && (glossy > 0.0) && (m.shininess >= shininess[k]) && (m.shininess <= shininess[k]);
      if (!any_lane(mine)) continue;
      const float* t = tables + (k + 1) * environment_lobe_floats;
      const Real share = environment_share(t, level);
      Real radiance[3];
      reflect(t, surface.mirror, radiance);
      for (int c = 0; c < 3; ++c) specular[c] = select(mine, radiance[c] * share, specular[c]);
    }
  }
};

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
