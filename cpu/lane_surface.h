// The surface that each lane sees. Included after cpu/simd.h and cpu/pixel_rays.h, anew for every target.
#if defined(AIRLIGHT_CPU_LANE_SURFACE_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AIRLIGHT_CPU_LANE_SURFACE_H
#undef AIRLIGHT_CPU_LANE_SURFACE_H
#else
#define AIRLIGHT_CPU_LANE_SURFACE_H
#endif

#include <vector>

#include "common/algorithms/view.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

// The materials' seven numbers for each lane.
struct LaneMaterial {
  Real diffuse[3], specular[3], shininess;
};

// One material is the same for all lanes; of several each lane looks up its own. A lane that hits nothing gets the first.
HWY_INLINE LaneMaterial lane_material(const std::vector<Material>& materials, Real index) {
  static_assert(sizeof(Material) == 7 * sizeof(float));
  LaneMaterial m;
  if (materials.size() == 1) {
    const Material& only = materials[0];
    for (int c = 0; c < 3; ++c) m.diffuse[c] = only.diffuse[c], m.specular[c] = only.specular[c];
    m.shininess = only.shininess;
    return m;
  }
  const auto* values = reinterpret_cast<const float*>(materials.data());
  const Real first = max(index, 0.0) * 7.0;
  for (int c = 0; c < 3; ++c) {
    m.diffuse[c] = fetch(values, first + c);
    m.specular[c] = fetch(values, first + 3.0 + c);
  }
  m.shininess = fetch(values, first + 6.0);
  return m;
}

// Which of the tabulated reflectances each lane's material has, -1: none.
HWY_INLINE Real lane_brdf(const std::vector<float>& of_material, Real index) {
  return fetch(of_material.data(), max(index, 0.0));
}

// The surfaces of pixels i .. i + lanes - 1 of a tile. Lanes outside `hit` have a place and a material all the same.
struct LaneSurface {
  Mask hit;
  Real index;  // of the material, below 0 without a hit
  LaneMaterial material;
  Real3 place, normal, mirror, viewer;  // mirror: the view ray reflected; viewer: the way back

  template <class Algorithm>
  HWY_INLINE LaneSurface(const Algorithm& a, const TileView& view, int i) {
    index = load(view.plane(a.material) + i);
    hit = index >= 0.0;
    if (!any_lane(hit)) return;
    material = lane_material(a.materials, index);
    const Real3 d = pixel_rays(a.view, view.tile, i);
    normal = {load(view.plane(a.normal, 0) + i), load(view.plane(a.normal, 1) + i), load(view.plane(a.normal, 2) + i)};
    const Real depth = select(hit, load(view.plane(a.distance) + i), 0.0);
    place = {d.x * depth, d.y * depth, d.z * depth};
    viewer = {-d.x, -d.y, -d.z};
    mirror = mirrored(normal, d);
  }
};

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
