// Gaussians as a vector of rays through a square of the screen meets them. Included after cpu/medium.h, anew for every target.
#if defined(AIRLIGHT_CPU_GAUSSIANS_ON_RAY_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AIRLIGHT_CPU_GAUSSIANS_ON_RAY_H
#undef AIRLIGHT_CPU_GAUSSIANS_ON_RAY_H
#else
#define AIRLIGHT_CPU_GAUSSIANS_ON_RAY_H
#endif

#include <algorithm>
#include <span>

#include "common/plan/gaussian_panels.h"
#include "cpu/gaussian_terms.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

namespace {

// What a ray knows of each Gaussian of the square, behind each other in `scratch`: a vector each. Strength: the extinction at the
// foot.
enum : std::ptrdiff_t { foot_at = 0, strength_at = lanes, start_at = 2 * lanes, floats_a_gaussian = 3 * lanes };

// What is at a place of the ray.
struct Local {
  Real extinction, scattering[3], emission[3];
  Real depth;  // of those Gaussians that are met there, up to this place; 0 without depths
};

struct GaussiansOnRay {
  const GaussianAirlight& a;
  const TileView& view;
  const GaussianPanels& panels;
  std::span<const GaussianTerms> terms;
  int erf;
  Real far;          // gaussian_erf() of all places far out
  bool with_depths;  // local() tells depths
  bool one_albedo, emits;
  float* scratch;

  HWY_INLINE GaussiansOnRay(const GaussianAirlight& algorithm, const TileView& tile_view, const GaussianPanels& square,
                            std::span<const GaussianTerms> of_gaussians, bool depths, float* floats);
  HWY_INLINE void begin(const Real3& d) const;
  HWY_INLINE Real erf_of(Real x) const;
  HWY_INLINE Real depth_of(std::uint32_t met, Real t) const;
  HWY_INLINE Local local(const GaussianPanels::Panel& p, Real t) const;
  template <int n>
  HWY_INLINE void extinctions(const GaussianPanels::Panel& p, const Real* t, Real* extinction) const;
  HWY_INLINE void locals(const GaussianPanels::Panel& p, const Real* t, std::size_t count, Local* here) const;
  HWY_INLINE Real shading(const GaussianPanels::Shade& s, std::size_t k, const Real3& place) const;
};

HWY_INLINE GaussiansOnRay::GaussiansOnRay(const GaussianAirlight& algorithm, const TileView& tile_view,
                                          const GaussianPanels& square, std::span<const GaussianTerms> of_gaussians, bool depths,
                                          float* floats)
    : a(algorithm),
      view(tile_view),
      panels(square),
      terms(of_gaussians),
      erf(static_cast<int>(algorithm.erf)),
      far(gaussian_erf(erf, erf_end())),
      with_depths(depths),
      one_albedo(true),
      emits(algorithm.emission != glm::vec3(0)),
      scratch(floats) {
  for (const std::uint32_t k : panels.met()) {
    one_albedo = one_albedo && (a.gaussians[k].albedo == a.albedo || !(a.extinction > 0));
    one_albedo = one_albedo && a.gaussians[k].albedo == a.gaussians[panels.met()[0]].albedo;
    emits = emits || a.gaussians[k].emission != glm::vec3(0);
  }
}

HWY_INLINE void GaussiansOnRay::begin(const Real3& d) const {
  float* floats = scratch;
  for (const std::uint32_t k : panels.met()) {
    const GaussianDensity& g = a.gaussians[k];
    const float inverse = terms[k].inverse;
    Real foot, h2;  // no root of it: a root takes as long as all else of a Gaussian
    const Real3 way = a.noise.amplitude > 0 ? bent_toward(a.noise, d, g) : d;
    perpendicular_squared(way.x, way.y, way.z, g.center.x, g.center.y, g.center.z, foot, h2);
    store(foot, floats + foot_at);
    store(select(h2 < g.reach * g.reach, gaussian_falloff(inverse, h2) * g.extinction, 0.0), floats + strength_at);
    if (with_depths) store(erf_of(foot * -inverse), floats + start_at);
    floats += floats_a_gaussian;
  }
}

// gaussian_erf(), of which most places of most rays need no more than what it is held at: Gaussians lie ahead of the camera and
// before surfaces as a whole.
HWY_INLINE Real GaussiansOnRay::erf_of(Real x) const {
  return any_lane(abs(x) < erf_end()) ? gaussian_erf(erf, x) : select(x > 0.0, far, -far);
}

// Optical depth of a Gaussian up to t.
HWY_INLINE Real GaussiansOnRay::depth_of(std::uint32_t met, Real t) const {
  const float* floats = scratch + static_cast<std::ptrdiff_t>(met) * floats_a_gaussian;
  const Real foot = load(floats + foot_at), strength = load(floats + strength_at);
  if (!any_lane(strength > 0.0)) return 0.0;
  const GaussianTerms& g = terms[panels.met()[met]];
  const Real start = with_depths ? load(floats + start_at) : erf_of(foot * -g.inverse);
  return gaussian_between(strength * g.length, start, erf_of((t - foot) * g.inverse));
}

// What is at a place.
HWY_INLINE Local GaussiansOnRay::local(const GaussianPanels::Panel& p, Real t) const {
  Local here;
  here.extinction = a.extinction;
  here.depth = 0.0;
  for (int c = 0; c < 3; ++c) {
    here.scattering[c] = a.extinction * a.albedo[c];
    here.emission[c] = a.emission[c];
  }
  for (std::uint32_t n = p.active.begin; n < p.active.end; ++n) {
    const std::uint32_t met = panels.indices()[n];
    const float* floats = scratch + static_cast<std::ptrdiff_t>(met) * floats_a_gaussian;
    const Real strength = load(floats + strength_at);
    if (!any_lane(strength > 0.0)) continue;
    const GaussianTerms& term = terms[panels.met()[met]];
    const Real past = t - load(floats + foot_at);
    if (with_depths) here.depth += depth_of(met, t);
    const Real extinction = strength * gaussian_falloff(term.inverse, past * past);
    here.extinction += extinction;
    const GaussianDensity& g = a.gaussians[panels.met()[met]];
    for (int c = 0; c < 3 && !one_albedo; ++c) here.scattering[c] = fma(extinction, g.albedo[c], here.scattering[c]);
    const Real falloff = extinction * term.over_extinction;
    for (int c = 0; c < 3 && emits; ++c) here.emission[c] = fma(falloff, g.emission[c], here.emission[c]);
  }
  if (one_albedo && p.active.begin < p.active.end) {
    const glm::vec3& albedo = a.gaussians[panels.met()[0]].albedo;
    for (int c = 0; c < 3; ++c) here.scattering[c] = here.extinction * albedo[c];
  }
  return here;
}

// The extinction of Gaussians at n places, whose exponential functions wait for each other less than those of n calls.
template <int n>
HWY_INLINE void GaussiansOnRay::extinctions(const GaussianPanels::Panel& p, const Real* t, Real* extinction) const {
  for (int k = 0; k < n; ++k) extinction[k] = 0.0;
  for (std::uint32_t at = p.active.begin; at < p.active.end; ++at) {
    const std::uint32_t met = panels.indices()[at];
    const float* floats = scratch + static_cast<std::ptrdiff_t>(met) * floats_a_gaussian;
    const Real strength = load(floats + strength_at);
    if (!any_lane(strength > 0.0)) continue;
    const Real foot = load(floats + foot_at);
    const float inverse = terms[panels.met()[met]].inverse;
    for (int k = 0; k < n; ++k) {
      const Real past = t[k] - foot;
      extinction[k] = fma(strength, gaussian_falloff(inverse, past * past), extinction[k]);
    }
  }
}

// What is at `count` places.
HWY_INLINE void GaussiansOnRay::locals(const GaussianPanels::Panel& p, const Real* t, std::size_t count, Local* here) const {
  if (!one_albedo || emits || with_depths) {
    for (std::size_t n = 0; n < count; ++n) here[n] = local(p, t[n]);
    return;
  }
  constexpr std::size_t block = 4;
  const bool any = p.active.begin < p.active.end;
  const glm::vec3& albedo = any ? a.gaussians[panels.met()[0]].albedo : a.albedo;
  for (std::size_t n = 0; n < count; n += block) {
    Real uneven[block];
    switch (count - n) {
      case 1:
        extinctions<1>(p, t + n, uneven);
        break;
      case 2:
        extinctions<2>(p, t + n, uneven);
        break;
      case 3:
        extinctions<3>(p, t + n, uneven);
        break;
      default:
        extinctions<4>(p, t + n, uneven);
    }
    for (std::size_t k = n; k < std::min(n + block, count); ++k) {
      here[k].extinction = uneven[k - n] + a.extinction;
      here[k].depth = 0.0;
      for (int c = 0; c < 3; ++c) here[k].scattering[c] = here[k].extinction * albedo[c];
    }
  }
}

// Optical depth of Gaussians between a place and light k.
HWY_INLINE Real GaussiansOnRay::shading(const GaussianPanels::Shade& s, std::size_t k, const Real3& place) const {
  Real depth = 0.0;
  if (!s.shaded) return depth;
  if (!a.depths.empty()) return depth_to_light(a.depth_volumes[k], view.floats(a.depths[k]), place);
  Real length;
  const Real3 way = toward_light(a.lights[k], place, length);
  for (std::uint32_t n = s.shading.begin; n < s.shading.end; ++n) {
    const std::uint32_t word = panels.indices()[n], index = word & ~GaussianPanels::around_light;
    const GaussianDensity& g = a.gaussians[index];
    const Real3 e = to_center(g, place);
    Real foot, h2;
    perpendicular_squared(way.x, way.y, way.z, e.x, e.y, e.z, foot, h2);
    const Mask met = h2 < g.reach * g.reach;
    if (!any_lane(met)) continue;
    const float inverse = terms[index].inverse;
    const bool whole_way = word == index;  // the light stands beyond it
    const Real share = gaussian_between(gaussian_falloff(inverse, h2), erf_of(foot * -inverse),
                                        whole_way ? Real(1.0) : erf_of((length - foot) * inverse));
    depth = fma(select(met, share, 0.0), terms[index].whole, depth);
  }
  return depth;
}

}  // namespace

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
