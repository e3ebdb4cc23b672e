#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/mean_depth.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/gaussian_mean_depth.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

// Lanes see few surfaces: each one's lattice is asked once for all that see it.
HWY_INLINE Real depth_in_lattices(const MeanDepth& a, table depths, Real index, const Real3& place) {
  HWY_ALIGN float surfaces[16];
  store(index, surfaces);
  Real depth = 0.0;
  for (int lane = 0; lane < lanes; ++lane) {
    const float surface = surfaces[lane];
    if (surface < 0 || (lane > 0 && surfaces[lane - 1] >= surface && surfaces[lane - 1] <= surface)) continue;
    const DepthLattice& l = a.lattices[static_cast<std::size_t>(surface)];
    const float scale = 1 / l.spacing;
    const Mask mine = (index >= surface) && (index <= surface);
    const Real found = value_among_nodes(depths + l.first, 0.0, static_cast<float>(l.nodes.x), static_cast<float>(l.nodes.y),
                                         static_cast<float>(l.nodes.z), (place.x - l.corner.x) * scale,
                                         (place.y - l.corner.y) * scale, (place.z - l.corner.z) * scale);
    depth = select(mine, found, depth);
  }
  return depth;
}

static void mean_depth(const MeanDepth& a, const TileView& view) {
  const float* depths = a.lattices.empty() ? nullptr : view.floats(a.depths);
  for (int i = 0; i < tile_pixels; i += lanes) {
    const Real index = load(view.plane(a.material) + i);
    const Mask hit = index >= 0.0;
    Real depth = 0.0;
    if (any_lane(hit)) {
      const Real3 d = pixel_rays(a.view, view.tile, i);
      const Real length = select(hit, load(view.plane(a.distance) + i), 0.0);
      const Real3 place{d.x * length, d.y * length, d.z * length};
      depth = depths ? depth_in_lattices(a, depths, index, place) : gaussian_mean_depth(a.gaussians, place);
    } else {
      view.skip(view.in_image(i, lanes));
    }
    store(select(hit, depth, 0.0), view.plane(a.mean_depth) + i);
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(mean_depth);

void run_tile(const MeanDepth& a, const TileView& view, Simd simd) { entry(HWY_DISPATCH_TABLE(mean_depth), simd)(a, view); }

}  // namespace airlight
#endif
