// The view rays of a tile's pixels and the ways to the lights, a vector of lanes at a time. Included after cpu/simd.h, anew for
// every target.
#if defined(AIRLIGHT_CPU_PIXEL_RAYS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AIRLIGHT_CPU_PIXEL_RAYS_H
#undef AIRLIGHT_CPU_PIXEL_RAYS_H
#else
#define AIRLIGHT_CPU_PIXEL_RAYS_H
#endif

#include "common/algorithms/view.h"
#include "cpu/tile.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

struct Real3 {
  Real x, y, z;
};
HWY_INLINE Real3 real3(const glm::vec3& v) { return {v.x, v.y, v.z}; }
HWY_INLINE Real dot(const Real3& a, const Real3& b) { return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z)); }
// A direction reflected by a surface of this unit normal.
HWY_INLINE Real3 mirrored(const Real3& n, const Real3& d) {
  const Real twice = dot(n, d) * 2.0;
  return {fma(-twice, n.x, d.x), fma(-twice, n.y, d.y), fma(-twice, n.z, d.z)};
}

// Unit directions of the rays of pixels i .. i + lanes - 1 of the tile.
HWY_INLINE Real3 pixel_rays(const View& view, const Tile& tile, int i) {
  const int x0 = tile.x + i % tile_side, y0 = tile.y + i / tile_side;
  const Real column = first_lanes() + static_cast<float>(x0);
  const Real row = static_cast<float>(y0);
  const auto width = static_cast<float>(view.extent.width), height = static_cast<float>(view.extent.height);
  const Real x = image_plane_x(column, view.offset.x, width, height, view.tan_half_fov);
  const Real y = image_plane_y(row, view.offset.y, height, view.tan_half_fov);
  Real3 d;
  view_ray(x, y, view.right.x, view.right.y, view.right.z, view.up.x, view.up.y, view.up.z, view.forward.x, view.forward.y,
           view.forward.z, d.x, d.y, d.z);
  return d;
}

// A point light beside a ray from the camera: where its foot is, and how far it is from there, at least its radius.
HWY_INLINE void beside_ray(const Light& light, const Real3& d, Real& foot, Real& h) {
  perpendicular(d.x, d.y, d.z, light.vector.x, light.vector.y, light.vector.z, light.radius, foot, h);
}

// What a light of unit power scatters into a ray on [x0, x1] in a homogeneous medium of albedo 1.
HWY_INLINE Real airlight_of(const Light& light, const Real3& d, table tables, const Phase& phase, float extinction, Real x0,
                            Real x1) {
  const int kind = static_cast<int>(phase.kind);
  const auto g = static_cast<float>(phase.g);
  if (light.directional) return directional_airlight(kind, g, extinction, -dot(real3(light.vector), d), x0, x1);
  Real foot, h;
  beside_ray(light, d, foot, h);
  return point_airlight(tables, kind, g, extinction, foot, h, x0, x1);
}

// A light seen from p: unit direction toward it, and how far it is; 1e15 for a directional one.
HWY_INLINE Real3 toward_light(const Light& light, const Real3& p, Real& length) {
  if (light.directional) {
    length = 1e15;
    return real3(-light.vector);
  }
  const Real3 way{light.vector.x - p.x, light.vector.y - p.y, light.vector.z - p.z};
  length = sqrt(max(dot(way, way), 1e-37));
  const Real scale = 1.0 / length;
  return {way.x * scale, way.y * scale, way.z * scale};
}

// What an algorithm that makes airlight and transmittance has for pixels i .. i + lanes - 1 whose rays have no length.
template <class Airlight>
HWY_INLINE void store_no_airlight(const Airlight& a, const TileView& view, int i) {
  const auto clear = [&](const Image& image) HWY_ATTR {
    for (int plane = 0; plane < image.layers * channels(image.format); ++plane) store(0.0, view.plane(image, plane) + i);
  };
  clear(a.airlight);
  if (a.per_light) clear(a.per_light);
  if (a.optical_depth) clear(a.optical_depth);
  store(1.0, view.plane(a.transmittance) + i);
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
