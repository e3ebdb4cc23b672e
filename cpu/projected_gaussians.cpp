#include "cpu/kernels.h"

#include <algorithm>
#include <glm/geometric.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/projected_gaussians.cpp"
#include <hwy/foreach_target.h>

#include "common/formulas/float.h"
#include "common/plan/gaussian_bins.h"
#include "cpu/gaussian_terms.h"
#include "cpu/held_images.h"
#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/medium.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

namespace {

// [1/m^2] of a Gaussian, per unit of intensity: a sample close to a light in a thick one may be far too bright, but is finite.
constexpr float most_scattered = 1e20F;

// What a ray knows of each light and has from it, behind each other in `scratch`: a vector each.
enum : std::ptrdiff_t { foot_at = 0, h_at = lanes, sum_at = 2 * lanes, floats_a_light = 5 * lanes };

// The rays of a vector of pixels.
struct Projection {
  const ProjectedGaussians& a;
  const TileView& view;
  int kind, erf;
  float g;
  float* scratch;

  Real3 d;
  Real length, end, depths, glow[3];  // depths: optical depth of the Gaussians

  HWY_INLINE Projection(const ProjectedGaussians& algorithm, const TileView& tile_view, float* floats)
      : a(algorithm),
        view(tile_view),
        kind(static_cast<int>(algorithm.phase.kind)),
        erf(static_cast<int>(algorithm.erf)),
        g(static_cast<float>(algorithm.phase.g)),
        scratch(floats) {}
  HWY_INLINE float* light_floats(std::size_t k) const { return scratch + static_cast<std::ptrdiff_t>(k) * floats_a_light; }
  HWY_INLINE void begin(int i);
  HWY_INLINE void add(const GaussianDensity& one, const GaussianTerms& terms, const float* more);
  HWY_INLINE void finish(int i) const;
};

// The homogeneous part: of each light (eq. 17).
HWY_INLINE void Projection::begin(int i) {
  length = ray_length(load(view.plane(a.distance) + i), a.sky_distance);
  d = pixel_rays(a.view, view.tile, i);
  end = min(length, 1e15);
  depths = 0.0;
  for (Real& part : glow) part = 0.0;
  for (std::size_t k = 0; k < a.lights.size(); ++k) {
    const Light& light = a.lights[k];
    float* floats = light_floats(k);
    Real foot = 0.0, h = 1.0, once = 0.0;
    if (!light.directional) beside_ray(light, d, foot, h);
    if (a.extinction > 0) {
      const Real through = transmittance(view.floats(a.light_to_camera)[k]);
      once = airlight_of(light, d, view.floats(a.tables), a.phase, a.extinction, 0.0, length) * through;
    }
    store(foot, floats + foot_at);
    store(h, floats + h_at);
    for (int c = 0; c < 3; ++c) store(once * (light.power[c] * a.albedo[c]), floats + sum_at + c * lanes);
  }
}

// A Gaussian. `more`: the optical depth of all else from its centre to the camera, then with that to each light.
HWY_INLINE void Projection::add(const GaussianDensity& one, const GaussianTerms& terms, const float* more) {
  Real foot, h;
  perpendicular(d.x, d.y, d.z, one.center.x, one.center.y, one.center.z, 0.0, foot, h);
  const Mask met = h < one.reach;
  if (!any_lane(met)) return;
  const Real lateral = select(met, gaussian_lateral(terms.inverse, h), 0.0);
  const Real erf_from = gaussian_erf(erf, foot * -terms.inverse), erf_to = gaussian_erf(erf, (end - foot) * terms.inverse);
  const Real depth = gaussian_between(lateral, erf_from, erf_to) * terms.whole;
  const Real before = gaussian_between(lateral, erf_from, gaussian_nearest(erf_from, erf_to)) * terms.whole;
  depths += depth;
  const Real t = min(max(foot, 0.0), end);
  const Real3 place = along({0.0, 0.0, 0.0}, d, t), e = to_center(one, place);
  for (std::size_t k = 0; k < a.lights.size(); ++k) {
    const Light& light = a.lights[k];
    float* floats = light_floats(k);
    Real way_length, foot_of_way, beside_way, density;
    const Real3 way = toward_light(light, place, way_length);
    perpendicular(way.x, way.y, way.z, e.x, e.y, e.z, 0.0, foot_of_way, beside_way);
    const Real behind = gaussian_depth(erf, terms.inverse, beside_way, -foot_of_way, way_length - foot_of_way) * terms.whole;
    const Real all = before + behind + more[k + 1];
    if (light.directional) {
      density = directional_density(kind, g, 0.0, -dot(real3(light.vector), d), t, all);
    } else {
      density = airlight_density(kind, g, 0.0, load(floats + foot_at), load(floats + h_at), t, all);
    }
    const Real scattered = min(depth * density, most_scattered);
    for (int c = 0; c < 3; ++c) {
      float* sum = floats + sum_at + c * lanes;
      store(fma(scattered, one.albedo[c] * light.power[c], load(sum)), sum);
    }
  }
  if (one.emission == glm::vec3(0)) return;
  const Real seen = depth * transmittance(before + more[0]) * terms.over_extinction;
  for (int c = 0; c < 3; ++c) glow[c] = fma(seen, one.emission[c], glow[c]);
}

HWY_INLINE void Projection::finish(int i) const {
  const Real tau = optical_depth(length, a.extinction) + depths;
  const Real source = opacity(tau);
  // As if the Gaussians were spread evenly over the ray.
  const Real emitting = attenuated_length(end, depths / max(end, 1e-30) + a.extinction, tau);
  for (int c = 0; c < 3; ++c) {
    Real all = fma(source, a.ambient[c], fma(emitting, a.emission[c], glow[c]));
    for (std::size_t k = 0; k < a.lights.size(); ++k) {
      const Real sum = load(light_floats(k) + sum_at + c * lanes);
      if (a.per_light) store(sum, view.plane(a.per_light, c, static_cast<int>(k)) + i);
      all += sum;
    }
    store(all, view.plane(a.airlight, c) + i);
  }
  store(transmittance(tau), view.plane(a.transmittance) + i);
  if (a.optical_depth) store(min(tau, 1e30), view.plane(a.optical_depth) + i);
}

}  // namespace

// One square of the tile, its upper left pixel at (x, y) in the tile; `more` of each Gaussian of the list as Projection::add()
// takes it.
static void projected_gaussians(const ProjectedGaussians& a, const TileView& view, std::span<const std::int32_t> list,
                                std::span<const GaussianTerms> terms, const float* more, AlignedFloats& scratch, int x, int y) {
  const std::size_t lights = a.lights.size();
  Projection p(a, view, scratch.resize(std::max<std::size_t>(lights, 1) * floats_a_light));
  for (int row = y; row < y + bin_side; ++row) {
    for (int column = x; column < x + bin_side; column += lanes) {
      const int i = row * tile_side + column;
      p.begin(i);
      for (std::size_t n = 0; n < list.size(); ++n)
        p.add(a.gaussians[static_cast<std::size_t>(list[n])], terms[n], more + n * (lights + 1));
      p.finish(i);
    }
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(projected_gaussians);

void run_tile(const ProjectedGaussians& a, const TileView& view, Simd simd) {
  static_assert(tile_side % bin_side == 0);
  const auto* bins = reinterpret_cast<const std::int32_t*>(view.floats(a.bins));
  std::vector<GaussianTerms> terms;
  std::vector<float> more;
  AlignedFloats scratch;
  for (int y = 0; y < tile_side; y += bin_side) {
    for (int x = 0; x < tile_side; x += bin_side) {
      if (view.tile.x + x >= a.view.extent.width || view.tile.y + y >= a.view.extent.height) continue;  // never read
      const int square = (view.tile.y + y) / bin_side * bin_columns(a.view.extent) + (view.tile.x + x) / bin_side;
      const std::span<const std::int32_t> list(bins + bins[square], bins + bins[square + 1]);
      if (list.empty()) view.skip(view.in_image(x, y, bin_side));
      terms.clear(), more.clear();
      for (const std::int32_t number : list) {
        const auto n = static_cast<std::size_t>(number);
        const GaussianDensity& g = a.gaussians[n];
        terms.push_back({1 / g.radius, f32::gaussian_whole(1, g.radius).v, f32::gaussian_whole(g.extinction, g.radius).v,
                         1 / std::max(g.extinction, 1e-37F)});
        const float eye = view.floats(a.to_camera)[n] + a.extinction * glm::length(g.center);
        more.push_back(eye);
        for (std::size_t k = 0; k < a.lights.size(); ++k) {
          const Light& light = a.lights[k];
          const float way = light.directional ? 0 : a.extinction * glm::length(g.center - light.vector);
          more.push_back(eye + view.floats(a.to_light[k])[n] + way);
        }
      }
      entry(HWY_DISPATCH_TABLE(projected_gaussians), simd)(a, view, list, terms, more.data(), scratch, x, y);
    }
  }
}

}  // namespace airlight
#endif
