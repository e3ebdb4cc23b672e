#include "common/algorithms/environment_light.h"
#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/hidden_environment.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

namespace {

// What the lanes look at when they look along the mirror direction: made when the first of them needs it.
struct LaneBasis {
  Real v[36];
  bool made = false;

  HWY_INLINE void make(const HiddenEnvironment& a, const TileView& view, int i) {
    if (made) return;
    const Real3 d = pixel_rays(a.view, view.tile, i);
    const Real3 n{load(view.plane(a.normal, 0) + i), load(view.plane(a.normal, 1) + i), load(view.plane(a.normal, 2) + i)};
    const Real3 mirror = mirrored(n, d);
    sh_basis(6, -mirror.z, mirror.x, mirror.y, v);
    made = true;
  }
};

// What is hidden from lanes that see tabulated reflectances: harmonics of each lane's own.
struct LaneHidden {
  Real of_channel[3][36];
  Real brdf;  // each lane's, -1: it has none, or nothing is hidden
  bool any = false;

  // Of three corners of a triangle that lanes `here` see, as many as have lobes; their weights are the lanes' own.
  HWY_INLINE void add(Mask here, const float* const* at, const float* lobes, const Real* weights) {
    if (!any) {
      for (auto& channel : of_channel) {
        for (Real& h : channel) h = 0.0;
      }
      brdf = -1.0;
    }
    any = true;
    brdf = select(here, at[0][4], brdf);
    for (int k = 0; k < 3; ++k) {
      if (at[k][3] < 0) continue;
      const float* lobe = lobes + hidden_lobe_floats * static_cast<std::ptrdiff_t>(at[k][3]);
      for (auto& channel : of_channel) {
        for (Real& h : channel) h = select(here, fma(weights[k], *lobe++, h), h);
      }
    }
  }
};

}  // namespace

static void hidden_environment(const HiddenEnvironment& a, const TileView& view) {
  const float* head = view.floats(a.table);
  const auto* triangles = reinterpret_cast<const std::uint32_t*>(view.floats(a.triangles));
  const auto vertices = static_cast<std::ptrdiff_t>(head[0]);
  const float* of_vertex = head + hidden_head_floats + brdf_lobe_floats * static_cast<std::size_t>(a.brdfs);
  const float* lobes = of_vertex + 2 * hidden_vertex_floats * vertices;
  const Ints di;
  HWY_ALIGN std::int32_t numbers[lanes];
  for (int i = 0; i < tile_pixels; i += lanes) {
    Real diffuse[3] = {0.0, 0.0, 0.0}, specular[3] = {0.0, 0.0, 0.0};
    const IntVec number = to_int(load(view.plane(a.corners) + i));
    const Real wb = load(view.plane(a.corners, 1) + i), wc = load(view.plane(a.corners, 2) + i);
    const Real weights[3] = {1.0 - wb - wc, wb, wc};
    LaneBasis basis;
    LaneHidden hidden;
    // Neighbouring pixels mostly see the same triangle: each different one is read once, for all lanes that see it.
    hn::Store(number, di, numbers);
    auto waiting = hn::Ne(number, hn::Zero(di));
    if (hn::AllFalse(di, waiting)) view.skip(view.in_image(i, lanes));
    while (!hn::AllFalse(di, waiting)) {
      const std::int32_t first = numbers[hn::FindFirstTrue(di, waiting)];
      const auto same = hn::Eq(number, hn::Set(di, first));
      waiting = hn::AndNot(same, waiting);
      const Mask here{hn::RebindMask(Floats(), same)};
      const std::uint32_t* corners = triangles + (static_cast<std::ptrdiff_t>(first < 0 ? -first : first) - 1) * 4;
      const float* at[3];
      for (int k = 0; k < 3; ++k)
        at[k] = of_vertex + hidden_vertex_floats * (corners[k] + (first < 0 ? vertices : std::ptrdiff_t{0}));
      for (int c = 0; c < 3; ++c) diffuse[c] = select(here, between_corners(at[0][c], at[1][c], at[2][c], wb, wc), diffuse[c]);
      if (!a.specular) continue;
      if (at[0][4] >= 0) {
        if (at[0][3] >= 0 || at[1][3] >= 0 || at[2][3] >= 0) hidden.add(here, at, lobes, weights);
        continue;
      }
      for (int k = 0; k < 3; ++k) {
        if (at[k][3] < 0) continue;
        basis.make(a, view, i);
        const float* lobe = lobes + hidden_lobe_floats * static_cast<std::ptrdiff_t>(at[k][3]);
        for (int c = 0; c < 3; ++c)
          specular[c] = select(here, fma(weights[k], sh_sum(lobe + c * 36, 6, basis.v), specular[c]), specular[c]);
      }
    }
    for (int c = 0; c < 3; ++c) store(diffuse[c], view.plane(a.diffuse, c) + i);
    if (!a.specular) continue;
    for (int b = 0; b < a.brdfs && hidden.any; ++b) {
      const Real one = static_cast<float>(b);
      const Mask mine = (hidden.brdf >= one) && (hidden.brdf <= one);
      if (!any_lane(mine)) continue;
      const Real3 d = pixel_rays(a.view, view.tile, i);
      Real sent[3];
      brdf_environment_part(hidden.of_channel[0], hidden.of_channel[1], hidden.of_channel[2],
                            head + hidden_head_floats + brdf_lobe_floats * static_cast<std::size_t>(b),
                            load(view.plane(a.normal, 0) + i), load(view.plane(a.normal, 1) + i),
                            load(view.plane(a.normal, 2) + i), -d.x, -d.y, -d.z, sent[0], sent[1], sent[2]);
      for (int c = 0; c < 3; ++c) specular[c] = select(mine, sent[c], specular[c]);
    }
    for (int c = 0; c < 3; ++c) store(specular[c], view.plane(a.specular, c) + i);
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(hidden_environment);

void run_tile(const HiddenEnvironment& a, const TileView& view, Simd simd) {
  entry(HWY_DISPATCH_TABLE(hidden_environment), simd)(a, view);
}

}  // namespace airlight
#endif
