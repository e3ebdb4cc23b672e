// Gaussians and grid for a vector of lanes: the extinction at a place, along a way and toward a light. Included after cpu/simd.h
// and cpu/pixel_rays.h, anew for every target.
#if defined(AIRLIGHT_CPU_MEDIUM_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AIRLIGHT_CPU_MEDIUM_H
#undef AIRLIGHT_CPU_MEDIUM_H
#else
#define AIRLIGHT_CPU_MEDIUM_H
#endif

#include <algorithm>

#include "common/algorithms/medium.h"
#include "common/algorithms/voxel_table.h"
#include "cpu/depth_volume.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

struct Stretch {
  Real begin, end;  // [m] along a way; empty where end <= begin
};

HWY_INLINE Real3 along(const Real3& from, const Real3& direction, Real t) {
  return {fma(direction.x, t, from.x), fma(direction.y, t, from.y), fma(direction.z, t, from.z)};
}

HWY_INLINE Real3 to_center(const GaussianDensity& g, const Real3& p) {
  return {g.center.x - p.x, g.center.y - p.y, g.center.z - p.z};
}

// Extinction and emission beside those at the centre; 0 beyond its reach.
HWY_INLINE Real falloff_at(const GaussianDensity& g, const Real3& p) {
  const Real3 e = to_center(g, p);
  const Real squared = dot(e, e);
  const Mask within = squared < g.reach * g.reach;
  if (!any_lane(within)) return 0.0;
  return select(within, gaussian_falloff(1 / g.radius, squared), 0.0);
}

// A grid and its table.
struct GridLookup {
  const GridDensity* grid;
  table values, bricks;

  HWY_INLINE Real coordinate(int axis, const Real3& p) const {
    const glm::vec4& row = grid->cells[axis];
    return fma(row.x, p.x, fma(row.y, p.y, fma(row.z, p.z, row.w)));
  }
  HWY_INLINE Real extinction_at(const Real3& p) const {
    const Real x = coordinate(0, p), y = coordinate(1, p), z = coordinate(2, p);
    if (!any_lane(grid_bound(bricks, x, y, z, grid->size.x, grid->size.y, grid->size.z) > 0.0)) return 0.0;
    if (grid->half_unit > 0) return grid->half_unit * grid_extinction(values, 1, x, y, z);
    return grid_extinction(values, 0, x, y, z);
  }
  // Where a way meets the box with half a cell around it.
  HWY_INLINE Stretch stretch(const Real3& from, const Real3& direction, Real length) const {
    Stretch s{0.0, length};
    for (int axis = 0; axis < 3; ++axis) {
      const glm::vec4& row = grid->cells[axis];
      const Real start = coordinate(axis, from);
      const Real slope = fma(row.x, direction.x, fma(row.y, direction.y, row.z * direction.z));
      const Real rate = select(abs(slope) > 1e-18, slope, 1e-18);
      const Real a = (-1.0 - start) / rate, b = (grid->size[axis] - start) / rate;
      s.begin = max(s.begin, min(a, b));
      s.end = min(s.end, max(a, b));
    }
    return s;
  }
};

// What light paths meet: everything but the homogeneous part.
struct MediumLookup {
  const std::vector<GaussianDensity>* gaussians;
  GridLookup grid;
  int light_steps;
  LightDepth light_depth;
  const std::vector<DepthVolume>* depth_volumes;  // with LightDepth::volume, and their tables
  const std::vector<Buffer>* depths;
  const TileView* view;
  int erf = static_cast<int>(Erf::accurate);

  template <class Algorithm>
  MediumLookup(const Algorithm& a, const TileView& tile_view)
      : gaussians(&a.gaussians),
        grid{&a.grid, nullptr, nullptr},
        light_steps(a.light_steps),
        light_depth(a.light_depth),
        depth_volumes(&a.depth_volumes),
        depths(&a.depths),
        view(&tile_view) {
    if constexpr (requires { a.erf; }) erf = static_cast<int>(a.erf);
    if (!a.grid) return;
    grid.values = tile_view.floats(a.voxels);
    grid.bricks = grid.values + bricks_at(a.grid);
  }
  // Without volumes toward the lights: optical depths of Gaussians are closed forms.
  MediumLookup(const std::vector<GaussianDensity>& all, const GridDensity& one, table voxels, int steps)
      : gaussians(&all),
        grid{&one, voxels, voxels},
        light_steps(steps),
        light_depth(LightDepth::analytic),
        depth_volumes(nullptr),
        depths(nullptr),
        view(nullptr) {
    if (one) grid.bricks += bricks_at(one);
  }
  bool any() const { return !gaussians->empty() || *grid.grid; }
};

// From where a way enters the first Gaussian's reach to where it leaves the last.
HWY_INLINE Stretch stretch_of(const std::vector<GaussianDensity>& gaussians, const Real3& from, const Real3& direction,
                              Real length) {
  Stretch all{1e30, -1e30};
  for (const GaussianDensity& g : gaussians) {
    const Real3 e = to_center(g, from);
    Real foot, h;
    perpendicular(direction.x, direction.y, direction.z, e.x, e.y, e.z, 0.0, foot, h);
    const Real half = sqrt(max((g.reach - h) * (g.reach + h), 0.0));
    const Real begin = max(foot - half, 0.0), end = min(foot + half, length);
    const Mask meets = (h < g.reach) && (begin < end);
    all.begin = select(meets, min(all.begin, begin), all.begin);
    all.end = select(meets, max(all.end, end), all.end);
  }
  return all;
}

// Optical depth of a stretch of a way, by the midpoints of n steps. Lanes outside `on` may give anything.
template <class ExtinctionAt>
HWY_INLINE Real marched_depth(const Stretch& s, const Real3& from, const Real3& direction, int n, Mask on,
                              ExtinctionAt&& extinction_at) {
  const Mask meets = s.begin < s.end;
  if (!any_lane(meets && on)) return 0.0;
  const Real begin = select(meets, s.begin, 0.0);
  const Real step = select(meets, (s.end - s.begin) * (1.0F / static_cast<float>(n)), 0.0);
  Real extinction = 0.0;
  for (int k = 0; k < n; ++k) extinction += extinction_at(along(from, direction, fma(step, static_cast<float>(k) + 0.5F, begin)));
  return extinction * step;
}

// Optical depth of a way that begins at `from`. Lanes outside `on` may give anything.
HWY_INLINE Real depth_of_way(const MediumLookup& medium, const Real3& from, const Real3& direction, Real length, Mask on) {
  Real sum = 0.0;
  const int n = medium.light_steps;
  if (medium.light_depth == LightDepth::analytic) {
    for (const GaussianDensity& g : *medium.gaussians) {
      const Real3 e = to_center(g, from);
      Real foot, h;
      perpendicular(direction.x, direction.y, direction.z, e.x, e.y, e.z, 0.0, foot, h);
      const Mask meets = (h < g.reach) && (foot > -g.reach) && (foot - length < g.reach);
      if (!any_lane(meets && on)) continue;
      const Real whole = gaussian_whole(g.extinction, g.radius);
      sum += select(meets, gaussian_depth(medium.erf, 1 / g.radius, h, -foot, length - foot) * whole, 0.0);
    }
  } else if (!medium.gaussians->empty()) {
    sum += marched_depth(stretch_of(*medium.gaussians, from, direction, length), from, direction, n, on,
                         [&](const Real3& p) HWY_ATTR {
                           Real extinction = 0.0;
                           for (const GaussianDensity& g : *medium.gaussians) {
                             extinction = fma(falloff_at(g, p), g.extinction, extinction);
                           }
                           return extinction;
                         });
  }
  if (*medium.grid.grid) {
    sum += marched_depth(medium.grid.stretch(from, direction, length), from, direction, n, on,
                         [&](const Real3& p) HWY_ATTR { return medium.grid.extinction_at(p); });
  }
  return sum;
}

// Optical depth of Gaussians and grid from p to light number k. Lanes outside `on` may give anything.
HWY_INLINE Real depth_to(const MediumLookup& medium, std::size_t k, const Light& light, const Real3& p, Mask on) {
  if (medium.light_depth == LightDepth::volume)
    return depth_to_light((*medium.depth_volumes)[k], medium.view->floats((*medium.depths)[k]), p);
  Real length;
  const Real3 way = toward_light(light, p, length);
  return depth_of_way(medium, p, way, length, on);
}

// What rays through Gaussians and a homogeneous part can have at most, were they seen through nothing.
struct RadianceBound {
  Real phase_most;  // [1/sr] largest value of the phase function
  float glow_most;  // [W/m^2/sr] largest emission / extinction

  template <class Algorithm>
  HWY_INLINE explicit RadianceBound(const Algorithm& a) {
    const int kind = static_cast<int>(a.phase.kind);
    const auto g = static_cast<float>(a.phase.g);
    phase_most = max(phase_value(kind, g, 1.0), phase_value(kind, g, -1.0));
    const auto largest = [](const glm::vec3& v) { return std::max({v.x, v.y, v.z}); };
    glow_most = largest(a.emission) > 0 ? largest(a.emission) / std::max(a.extinction, 1e-30F) : 0;
    for (const GaussianDensity& one : a.gaussians) glow_most += largest(one.emission) / one.extinction;
    glow_most = std::min(glow_most, 1e30F);
  }
  // [W/m^2/sr] of each lane's ray.
  template <class Algorithm>
  HWY_INLINE Real of(const Algorithm& a, const Real3& d) const {
    Real most = glow_most;
    for (const Light& light : a.lights) {
      const Real power = std::max({light.power.x, light.power.y, light.power.z});
      Real foot, h = 1.0;
      if (!light.directional) beside_ray(light, d, foot, h);
      most += power * phase_most / (h * h);
    }
    return most;
  }
};

// The direction in which a ray crosses a Gaussian.
HWY_INLINE Real3 bent_toward(const RayNoise& noise, const Real3& d, const GaussianDensity& g) {
  Real3 way;
  bent_ray(d.x, d.y, d.z, g.center.x, g.center.y, g.center.z, g.radius, noise.amplitude, 1 / noise.scale, noise.offset.x,
           noise.offset.y, noise.offset.z, way.x, way.y, way.z);
  return way;
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
