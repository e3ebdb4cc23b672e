// The material of each lane. Included after cpu/simd.h, anew for every target.
#if defined(AIRLIGHT_CPU_LANE_MATERIAL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AIRLIGHT_CPU_LANE_MATERIAL_H
#undef AIRLIGHT_CPU_LANE_MATERIAL_H
#else
#define AIRLIGHT_CPU_LANE_MATERIAL_H
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

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
