#include "cpu/kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/ray_march.cpp"
#include <hwy/foreach_target.h>

#include "cpu/held_images.h"
#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/known_ray.h"
//
#include "cpu/lit_rays.h"
#include "cpu/medium.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

namespace {

// What a ray knows of each light, behind each other in `scratch`: a vector each. 1 / h; how far the last step's end is from it.
enum : std::ptrdiff_t { foot_at = 0, h_at = lanes, over_h_at = 2 * lanes, end_at = 3 * lanes, floats_a_light = 4 * lanes };

// What is at a place of the ray.
struct Local {
  Real extinction, scattering[3], emission[3];
};

// The rays of a vector of pixels on their way.
struct March {
  const RayMarch& a;
  const TileView& view;
  MediumLookup medium;
  LitRays lit;
  RadianceBound bound;
  bool peaked, one_albedo, emits;  // peaked: the phase function has a peak
  table sources;                   // null without
  float* scratch;

  int i = 0;                             // the first pixel
  bool follows = false;                  // this step begins where that before ended, as the scratch holds
  bool uneven = false;                   // this stretch has Gaussians and grid
  int all_steps = 0, skipped_steps = 0;  // of the vector's stretches
  Real3 d;
  Real front, within;  // optical depth so far, and that of Gaussians and grid alone
  Real most;           // radiance that the whole ray can have, were it seen through nothing
  Mask going;
  Real sum[3];

  HWY_INLINE March(const RayMarch& algorithm, const TileView& tile_view, const LitRays& lit_rays, float* floats);
  HWY_INLINE void begin(int first, const Real3& direction);
  HWY_INLINE Mask ended() const;
  HWY_NOINLINE void stretch(Real begin, Real end, bool all);  // asked three times, a half of what there is to compile
  HWY_INLINE Local local(const Real3& p, bool all) const;
  HWY_INLINE void add_light(std::size_t k, Real from, Real to, Real before_it, const Local& here);
  HWY_NOINLINE void add_part(std::size_t k, Real from, Real to, Real before_it, Real tau, const Local& here);
};

HWY_INLINE March::March(const RayMarch& algorithm, const TileView& tile_view, const LitRays& lit_rays, float* floats)
    : a(algorithm),
      view(tile_view),
      medium(algorithm, tile_view),
      lit(lit_rays),
      bound(algorithm),
      peaked(algorithm.phase.kind > PhaseKind::rayleigh),
      one_albedo(true),
      emits(algorithm.emission != glm::vec3(0) || algorithm.sources),
      sources(algorithm.sources ? tile_view.floats(algorithm.sources) : nullptr),
      scratch(floats) {
  for (const GaussianDensity& g : a.gaussians) {
    one_albedo = one_albedo && g.albedo == a.albedo;
    emits = emits || g.emission != glm::vec3(0);
  }
  if (a.grid) one_albedo = one_albedo && a.grid.albedo == a.albedo;
}

HWY_INLINE void March::begin(int first, const Real3& direction) {
  i = first;
  d = direction;
  all_steps = skipped_steps = 0;
  front = within = 0.0;
  going = Real(0.0) < Real(1.0);
  for (Real& s : sum) s = 0.0;
  most = bound.of(a, d);
  if (sources) most += sources[3];
  if (lit) lit.begin(i);
  float* of_light = scratch;
  for (const Light& light : a.lights) {
    Real foot = 0.0, h = 1.0;
    if (!light.directional) beside_ray(light, d, foot, h);
    store(foot, of_light + foot_at);
    store(h, of_light + h_at);
    store(1.0 / h, of_light + over_h_at);
    of_light += floats_a_light;
  }
  if (!a.per_light) return;
  for (std::size_t k = 0; k < a.lights.size(); ++k) {
    for (int c = 0; c < 3; ++c) store(0.0, view.plane(a.per_light, c, static_cast<int>(k)) + i);
  }
}

HWY_INLINE Mask March::ended() const { return ray_ended(front, most, max(max(sum[0], sum[1]), sum[2])); }

HWY_INLINE Local March::local(const Real3& p, bool all) const {
  Local here;
  here.extinction = a.extinction;
  for (int c = 0; c < 3; ++c) {
    here.scattering[c] = a.extinction * a.albedo[c];
    here.emission[c] = a.emission[c];
  }
  if (!all) return here;
  const auto add = [&](Real extinction, const glm::vec3& albedo) HWY_ATTR {
    here.extinction += extinction;
    if (one_albedo) return;
    for (int c = 0; c < 3; ++c) here.scattering[c] = fma(extinction, albedo[c], here.scattering[c]);
  };
  for (const GaussianDensity& g : a.gaussians) {
    const Real falloff = falloff_at(g, p);
    add(falloff * g.extinction, g.albedo);
    if (!emits) continue;
    for (int c = 0; c < 3; ++c) here.emission[c] = fma(falloff, g.emission[c], here.emission[c]);
  }
  if (a.grid) add(medium.grid.extinction_at(p), a.grid.albedo);
  if (one_albedo) {
    for (int c = 0; c < 3; ++c) here.scattering[c] = here.extinction * a.albedo[c];
  }
  if (sources) {
    const glm::vec3 &first = a.source_first, scale = 1.0F / a.source_spacing;
    const Real x = (p.x - first.x) * scale.x, y = (p.y - first.y) * scale.y, z = (p.z - first.z) * scale.z;
    for (int c = 0; c < 3; ++c) {
      const Real scattered = max(here.scattering[c] - a.extinction * a.albedo[c], 0.0);
      here.emission[c] = fma(scattered, source_in_volume(sources, c, x, y, z), here.emission[c]);
    }
  }
  return here;
}

// Light number k, scattered in the step [from, to] or in a lit part of one, where the medium is `here`: behind `before_it`.
// Nothing where to <= from. Beside a lamp, where light and the medium or a peak of the phase function change much within a step,
// in parts that look up the medium anew.
HWY_INLINE void March::add_light(std::size_t k, Real from, Real to, Real before_it, const Local& here) {
  Real s = 0.0, c = 1.0, sine = 0.0, cosine = 1.0, parts = 1.0, foot = 0.0, h = 1.0;
  if ((uneven || peaked) && !a.lights[k].directional) {
    const float* of_light = scratch + static_cast<std::ptrdiff_t>(k) * floats_a_light;
    foot = load(of_light + foot_at), h = load(of_light + h_at);
    const Real before = from - foot, after = to - foot;
    const Real ra2 = fma(before, before, h * h), rb2 = fma(after, after, h * h);
    // A step whose middle has nothing is passed by, unless another lane needs it: it must scatter nothing there, too.
    const Mask lit_there = going && (from < to) && (here.extinction > 0.0);
    const Mask wide = lit_there && may_have_parts(to - from, min(ra2, rb2));
    if (any_lane(wide)) {
      const Real over_ra = 1.0 / sqrt(ra2), over_rb = 1.0 / sqrt(rb2);
      s = before * over_ra, c = h * over_ra;
      parts = select(wide, step_parts(s, c, after * over_rb, h * over_rb, sine, cosine), 1.0);
    }
  }
  const bool in_parts = any_lane(parts > 1.0);
  Real begin = from;
  for (int done = 1;; ++done) {
    const Mask more = parts > static_cast<float>(done);
    const bool any_more = any_lane(more);
    Real end = to;
    if (any_more) end = select(more, end_of_part(sine, cosine, s, c, begin, to, foot, h, s, c), to);
    Local there = here;
    if (in_parts) {
      const Mask whole = parts <= 1.0;
      there = local(along({0.0, 0.0, 0.0}, d, (begin + end) * 0.5), uneven);
      there.extinction = select(whole, here.extinction, there.extinction);
      for (int i3 = 0; i3 < 3; ++i3) there.scattering[i3] = select(whole, here.scattering[i3], there.scattering[i3]);
    }
    const Real tau = there.extinction * (end - begin);
    add_part(k, begin, end, before_it, tau, there);
    if (!any_more) return;
    before_it += tau;
    begin = end;
  }
}

// A part of a step, or all of it: of optical depth tau.
HWY_NOINLINE void March::add_part(std::size_t k, Real from, Real to, Real before_it, Real tau, const Local& here) {
  const Light& light = a.lights[k];
  const int kind = static_cast<int>(a.phase.kind);
  const auto g = static_cast<float>(a.phase.g);
  Real at, weight, beside = 0.0, phase, sampled;
  const Local* there = &here;
  Local nearer;
  if (light.directional) {
    sampled = at = (from + to) * 0.5;
    weight = to - from;
    phase = phase_value(kind, g, -dot(real3(light.vector), d));
  } else {
    float* of_light = scratch + static_cast<std::ptrdiff_t>(k) * floats_a_light;
    const Real foot = load(of_light + foot_at), h = load(of_light + h_at);
    const Real before = from - foot, after = to - foot;
    const Real ra = follows ? load(of_light + end_at) : sqrt(fma(before, before, h * h)), rb = sqrt(fma(after, after, h * h));
    store(rb, of_light + end_at);
    weight = step_angle(from, to, ra, rb, foot, h, load(of_light + over_h_at));
    Real r;
    step_means(from, to, ra, rb, foot, h, weight, at, r);
    phase = step_phase(kind, g, before, after, ra, rb, h);
    beside = r * a.extinction;
    sampled = at;
    // Beside a lamp the medium is looked up where most of the light is scattered, and its shadow where the lamp is as far as on
    // the mean.
    const Mask near = near_light(from, to, ra, rb) && (here.extinction > 0.0);
    if (uneven && any_lane(near && going)) {
      sampled = select(near, place_at_distance(at, r, foot, h), at);
      nearer = local(along({0.0, 0.0, 0.0}, d, at), true);
      for (int c = 0; c < 3; ++c) nearer.scattering[c] = select(near, nearer.scattering[c], here.scattering[c]);
      there = &nearer;
    }
  }
  if (medium.any()) {
    beside += depth_to(medium, k, light, along({0.0, 0.0, 0.0}, d, sampled), going);
  }
  const Real share = (at - from) / max(to - from, 1e-30);
  const Mask scatters = lit ? going && (from < to) : going;
  const Real once = phase * weight * step_transmittance(before_it, tau, share, beside);
  for (int c = 0; c < 3; ++c) {
    const Real light_of_step = select(scatters, there->scattering[c] * once * light.power[c], 0.0);
    sum[c] += light_of_step;
    if (!a.per_light) continue;
    float* plane = view.plane(a.per_light, c, static_cast<int>(k)) + i;
    store(load(plane) + light_of_step, plane);
  }
}

// From `begin` to `end` in a.steps, which grow as if the medium were everywhere as dense as at `begin`; all: with Gaussians and
// grid. Rays for which end <= begin stand still.
HWY_NOINLINE void March::stretch(Real begin, Real end, bool all) {
  const Mask marching = !ended() && (begin < end);
  if (!any_lane(marching)) return;
  if (!all && !(a.extinction > 0)) {  // nothing there but a glow
    const Real glow = select(marching, (end - begin) * transmittance(front), 0.0);
    for (int c = 0; c < 3; ++c) sum[c] = fma(glow, a.emission[c], sum[c]);
    return;
  }
  const bool whole = static_cast<bool>(a.optical_depth);  // it is wanted also behind where the ray ends
  const Real length = select(marching, all ? end - begin : min(end - begin, deepest() / max(Real(a.extinction), 1e-30F)), 0.0);
  const float n = static_cast<float>(a.steps);
  const Real steep = local(along({0.0, 0.0, 0.0}, d, begin), all).extinction;
  const bool even = !any_lane(steep * length >= 0.02);  // as graded_step() has it: the same bits
  Real from = begin;
  follows = false;
  uneven = all;
  all_steps += a.steps;
  for (int k = 0; k < a.steps; ++k) {
    going = marching && !ended();
    if (!any_lane(going) && !(whole && all)) {
      skipped_steps += a.steps - k;
      break;
    }
    const float next = static_cast<float>(k + 1);
    const Real to = begin + (even ? length * (next / n) : graded_step(next, n, length, steep));
    const Real size = max(to - from, 0.0);
    const Local here = local(along({0.0, 0.0, 0.0}, d, (from + to) * 0.5), all);
    const Real tau = here.extinction * size;
    const bool scatters = any_lane(going && (here.extinction > 0.0));
    if (scatters) {
      for (std::size_t l = 0; l < a.lights.size(); ++l) {
        if (!lit) {
          add_light(l, from, to, front, here);
        } else {
          lit.each(l, from, to, [&](Real begin_lit, Real end_lit) HWY_ATTR {
            add_light(l, begin_lit, end_lit, fma(here.extinction, begin_lit - from, front), here);
          });
        }
      }
    }
    follows = scatters && !lit;
    if (emits) {
      const Real seen = select(going, size * mean_transmittance(tau) * transmittance(front), 0.0);
      for (int c = 0; c < 3; ++c) sum[c] = fma(seen, here.emission[c], sum[c]);
    }
    const Mask counts = going || (whole ? marching : going);
    front += select(counts, tau, 0.0);
    if (all) within += select(counts, max(here.extinction - a.extinction, 0.0) * size, 0.0);
    from = to;
  }
}

}  // namespace

static void ray_march(const RayMarch& a, const TileView& view, std::span<const LitParts> lit, LitScratch& lit_scratch,
                      AlignedFloats& scratch) {
  const float* distance = view.plane(a.distance);
  March march(a, view, LitRays(lit, lit_scratch), scratch.resize(a.lights.size() * floats_a_light));
  StepCounts counts;
  KnownRay known;
  known.possible = lit.empty() && has_even_fog(a);
  for (int i = 0; i < tile_pixels; i += lanes) {
    const Real length = ray_length(load(distance + i), a.sky_distance), end = min(length, 1e15);
    const int pixels = view.in_image(i, lanes);
    if (!any_lane(length > 0.0)) {
      store_no_airlight(a, view, i);
      counts.skipped += static_cast<std::uint64_t>(pixels);
      continue;
    }
    const Real3 d = pixel_rays(a.view, view.tile, i);
    Stretch inside{0.0, 0.0};  // Gaussians and grid
    if (march.medium.any()) {
      const Real3 camera{0.0, 0.0, 0.0};
      inside = stretch_of(a.gaussians, camera, d, end);
      if (a.grid) {
        const Stretch box = march.medium.grid.stretch(camera, d, end);
        const Mask meets = box.begin < box.end;
        inside.begin = select(meets, min(inside.begin, box.begin), inside.begin);
        inside.end = select(meets, max(inside.end, box.end), inside.end);
      }
    }
    const Mask meets = inside.begin < inside.end;
    const bool fog_alone = !any_lane(meets);
    if (fog_alone && store_known(a, view, known, distance, i)) continue;
    inside.begin = select(meets, inside.begin, 0.0);
    const Real behind = select(meets, inside.end, 0.0);
    march.begin(i, d);
    if (march.medium.any()) {
      march.stretch(0.0, inside.begin, false);
      march.stretch(inside.begin, behind, true);
    }
    march.stretch(behind, end, false);
    if (march.all_steps == 0) counts.skipped += static_cast<std::uint64_t>(pixels);
    counts.parts += static_cast<std::uint64_t>(march.all_steps) * static_cast<std::uint64_t>(pixels);
    counts.skipped_parts += static_cast<std::uint64_t>(march.skipped_steps) * static_cast<std::uint64_t>(pixels);

    const Real tau = optical_depth(length, a.extinction) + march.within;
    const Real through = select(march.ended(), 0.0, transmittance(tau));
    const Real source = opacity(tau);
    for (int c = 0; c < 3; ++c) store(fma(source, a.ambient[c], march.sum[c]), view.plane(a.airlight, c) + i);
    store(through, view.plane(a.transmittance) + i);
    if (a.optical_depth) store(min(tau, 1e30), view.plane(a.optical_depth) + i);
    if (fog_alone) keep_known(a, view, known, distance, i);
  }
  view.counts->add(counts);
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(ray_march);

void run_tile(const RayMarch& a, const TileView& view, Simd simd, std::span<const LitParts> lit) {
  thread_local LitScratch lit_scratch;  // kept for their memory alone
  thread_local AlignedFloats scratch;
  entry(HWY_DISPATCH_TABLE(ray_march), simd)(a, view, lit, lit_scratch, scratch);
}

}  // namespace airlight
#endif
