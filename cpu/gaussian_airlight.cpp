#include "cpu/kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/gaussian_airlight.cpp"
#include <hwy/foreach_target.h>

#include "common/formulas/float.h"
#include "cpu/held_images.h"
#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/lit_rays.h"
#include "cpu/medium.h"
//
#include "cpu/gaussians_on_ray.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

namespace {

// The rays of a vector of pixels on their way through the panels.
struct Scattering {
  const GaussianAirlight& a;
  const TileView& view;
  const GaussianPanels& panels;
  std::span<const GaussLegendre> rules;  // of one node and more
  GaussiansOnRay gaussians;
  RadianceBound bound;
  const float* tables;
  LitRays lit;

  int i = 0;  // the first pixel
  Mask mine;  // pixels of the square
  int skipped_panels = 0;
  Real3 d;
  Real end, front, most, sum[3];  // front: optical depth of Gaussians so far; with shadow volumes, of those that are behind

  HWY_INLINE Scattering(const GaussianAirlight& algorithm, const TileView& tile_view, const GaussianPanels& square,
                        std::span<const GaussLegendre> quadratures, std::span<const GaussianTerms> of_gaussians, float* floats,
                        const LitRays& lit_rays);
  HWY_INLINE void put(Real value, float* plane) const { store(select(mine, value, load(plane + i)), plane + i); }
  HWY_INLINE void begin(int first, Mask of_square, Real length);
  HWY_INLINE void add(std::size_t light, const Real* scattered);
  HWY_NOINLINE void scatter(const GaussianPanels::Shade& s, std::size_t k, Real t, Real weight, const Local& here);
  HWY_INLINE void glow(Real t, Real weight, const Local& here);
  HWY_INLINE void node(const GaussianPanels::Panel& p, Real t, Real weight, const Local& here);
  HWY_NOINLINE void sample(const GaussianPanels::Panel& p, Real from, Real to);
  HWY_INLINE const GaussLegendre& rule_of(const GaussianPanels::Panel& p) const {
    return rules[static_cast<std::size_t>(p.samples - 1)];
  }
  HWY_INLINE void sample_lit(const GaussianPanels::Panel& p, Real from, Real to);
  HWY_INLINE void closed_forms(const GaussianPanels::Panel& p, Real from, Real to, Mask going);
  HWY_NOINLINE int cuts(const GaussianPanels::Panel& p, Real from, Real to, Real* cut) const;
  HWY_INLINE void panel(const GaussianPanels::Panel& p);
};

HWY_INLINE Scattering::Scattering(const GaussianAirlight& algorithm, const TileView& tile_view, const GaussianPanels& square,
                                  std::span<const GaussLegendre> quadratures, std::span<const GaussianTerms> of_gaussians,
                                  float* floats, const LitRays& lit_rays)
    : a(algorithm),
      view(tile_view),
      panels(square),
      rules(quadratures),
      gaussians(algorithm, tile_view, square, of_gaussians, static_cast<bool>(algorithm.volumes), floats),
      bound(algorithm),
      tables(tile_view.floats(algorithm.tables)),
      lit(lit_rays) {}

HWY_INLINE void Scattering::begin(int first, Mask of_square, Real length) {
  i = first;
  mine = of_square;
  skipped_panels = 0;
  d = pixel_rays(a.view, view.tile, i);
  end = min(length, 1e15);
  front = 0.0;
  for (Real& s : sum) s = 0.0;
  most = bound.of(a, d);
  if (lit) lit.begin(i);
  gaussians.begin(d);
  if (!a.per_light) return;
  for (std::size_t k = 0; k < a.lights.size(); ++k) {
    for (int c = 0; c < 3; ++c) put(0.0, view.plane(a.per_light, c, static_cast<int>(k)));
  }
}

HWY_INLINE void Scattering::add(std::size_t light, const Real* scattered) {
  for (int c = 0; c < 3; ++c) {
    sum[c] += scattered[c];
    if (!a.per_light) continue;
    float* plane = view.plane(a.per_light, c, static_cast<int>(light));
    put(load(plane + i) + scattered[c], plane);
  }
}

// What light k adds at a node of this weight.
HWY_NOINLINE void Scattering::scatter(const GaussianPanels::Shade& shade, std::size_t k, Real t, Real weight, const Local& here) {
  const int kind = static_cast<int>(a.phase.kind);
  const auto g = static_cast<float>(a.phase.g);
  const Light& light = a.lights[k];
  const Real more = here.depth + gaussians.shading(shade, k, along({0.0, 0.0, 0.0}, d, t));
  Real density;
  if (light.directional) {
    density = directional_density(kind, g, a.extinction, -dot(real3(light.vector), d), t, more);
  } else {
    Real foot, h;
    beside_ray(light, d, foot, h);
    density = airlight_density(kind, g, a.extinction, foot, h, t, more);
  }
  const Real once = weight * density;
  Real scattered[3];
  for (int c = 0; c < 3; ++c) scattered[c] = here.scattering[c] * once * light.power[c];
  add(k, scattered);
}

HWY_INLINE void Scattering::glow(Real t, Real weight, const Local& here) {
  const Real seen = weight * transmittance(fma(t, a.extinction, here.depth));
  for (int c = 0; c < 3; ++c) sum[c] = fma(seen, here.emission[c], sum[c]);
}

// What all lights and the medium itself send from a node.
HWY_INLINE void Scattering::node(const GaussianPanels::Panel& p, Real t, Real weight, const Local& here) {
  for (std::size_t k = 0; k < a.lights.size(); ++k) {
    const GaussianPanels::Shade& shade = panels.shades()[p.shades + k];
    if (!GaussianPanels::closed_form(p, shade)) scatter(shade, k, t, weight, here);
  }
  if (gaussians.emits && p.active.begin < p.active.end) glow(t, weight, here);
}

// From `from` to `to` by the nodes, of which the depth comes, too, unless surfaces may throw a shadow: then errors of extinction
// in front and of what it scatters make up for each other. Nothing where to <= from.
HWY_NOINLINE void Scattering::sample(const GaussianPanels::Panel& p, Real from, Real to) {
  const GaussLegendre& rule = rule_of(p);
  const std::size_t count = rule.node.size();
  const Real half = max(to - from, 0.0) * 0.5, middle = (from + to) * 0.5;
  Local here[GaussianAirlight::most_samples];
  Real t[GaussianAirlight::most_samples], uneven[GaussianAirlight::most_samples];
  for (std::size_t n = 0; n < count; ++n) t[n] = fma(half, rule.node[n], middle);
  gaussians.locals(p, t, count, here);
  for (std::size_t n = 0; n < count; ++n) uneven[n] = (here[n].extinction - a.extinction) * half;
  Real whole = front;
  for (std::size_t n = 0; n < count; ++n) {
    here[n].depth += front;
    for (std::size_t k = 0; k < count && !gaussians.with_depths; ++k)
      here[n].depth = fma(uneven[k], rule.before[n * count + k], here[n].depth);
    node(p, t[n], half * rule.weight[n], here[n]);
    whole = fma(uneven[n], rule.weight[n], whole);
  }
  if (!gaussians.with_depths) front = whole;
}

// The same where lights reach only parts of rays: each part has nodes of its own, and depths are closed forms. A light that
// reaches all or nothing between the ends takes those of the whole.
HWY_INLINE void Scattering::sample_lit(const GaussianPanels::Panel& p, Real from, Real to) {
  const GaussLegendre& rule = rule_of(p);
  Local whole[GaussianAirlight::most_samples];
  bool known = false;
  const auto at = [&](Real t) HWY_ATTR {
    Local here = gaussians.local(p, t);
    here.depth += front;
    return here;
  };
  const auto nodes = [&](Real x0, Real x1, const Local* held, auto&& use) HWY_ATTR {
    const Real half = max(x1 - x0, 0.0) * 0.5, middle = (x0 + x1) * 0.5;
    for (std::size_t n = 0; n < rule.node.size(); ++n) {
      const Real t = fma(half, rule.node[n], middle);
      use(n, t, half * rule.weight[n], held ? held[n] : at(t));
    }
  };
  const auto know = [&]() HWY_ATTR {
    if (!known) nodes(from, to, nullptr, [&](std::size_t n, Real, Real, const Local& here) HWY_ATTR { whole[n] = here; });
    known = true;
  };
  for (std::size_t k = 0; k < a.lights.size(); ++k) {
    const GaussianPanels::Shade& shade = panels.shades()[p.shades + k];
    if (GaussianPanels::closed_form(p, shade)) continue;
    lit.each(k, from, to, [&](Real x0, Real x1) HWY_ATTR {
      const Mask there = x0 < x1;
      const bool all = !any_lane(there && (from < x0 || x1 < to));
      if (all) know();
      nodes(all ? from : x0, all ? to : x1, all ? whole : nullptr,
            [&](std::size_t, Real t, Real weight, const Local& here)
                HWY_ATTR { scatter(shade, k, t, select(there, weight, 0.0), here); });
    });
  }
  if (!gaussians.emits || p.active.begin == p.active.end) return;
  know();
  nodes(from, to, whole, [&](std::size_t, Real t, Real weight, const Local& here) HWY_ATTR { glow(t, weight, here); });
}

// Where only the homogeneous part is.
HWY_INLINE void Scattering::closed_forms(const GaussianPanels::Panel& p, Real from, Real to, Mask going) {
  const Real through = select(going, transmittance(front), 0.0);
  for (std::size_t k = 0; k < a.lights.size() && a.extinction > 0; ++k) {
    if (!GaussianPanels::closed_form(p, panels.shades()[p.shades + k])) continue;
    const Light& light = a.lights[k];
    Real once = 0.0;
    if (!lit) {
      once = airlight_of(light, d, tables, a.phase, a.extinction, from, to);
    } else {
      lit.each(k, from, to, [&](Real x0, Real x1) HWY_ATTR {
        once += select(x0 < x1, airlight_of(light, d, tables, a.phase, a.extinction, x0, x1), 0.0);
      });
    }
    Real scattered[3];
    for (int c = 0; c < 3; ++c) scattered[c] = once * through * (light.power[c] * a.albedo[c]);
    add(k, scattered);
  }
  if (a.emission == glm::vec3(0)) return;
  const Real length = to - from;
  const Real seen =
      through * transmittance(from * a.extinction) * attenuated_length(length, a.extinction, optical_depth(length, a.extinction));
  for (int c = 0; c < 3; ++c) sum[c] = fma(seen, a.emission[c], sum[c]);
}

// Where the panel is cut, ascending, its ends among them. Returns how many.
HWY_NOINLINE int Scattering::cuts(const GaussianPanels::Panel& p, Real from, Real to, Real* cut) const {
  int n = 0;
  bool sorted = true;
  cut[n++] = from;
  for (std::size_t k = 0; k < a.lights.size(); ++k) {
    const auto levels = static_cast<int>(panels.shades()[p.shades + k].levels);
    if (levels == 0) continue;
    sorted = n == 1;
    const Light& light = a.lights[k];
    Real foot, h;
    beside_ray(light, d, foot, h);
    const auto at = [&](Real t) HWY_ATTR { cut[n++] = min(max(t, from), to); };
    float step = p.end - p.begin;
    for (int level = 0; level < levels; ++level) at(foot - (step *= 1 / GaussianPanels::cut_ratio));
    at(foot);
    for (int level = 0; level < levels; ++level, step *= GaussianPanels::cut_ratio) at(foot + step);
  }
  cut[n++] = to;
  for (int last = n - 1; last > 0 && !sorted; --last) {
    for (int k = 0; k < last; ++k) {
      const Real less = min(cut[k], cut[k + 1]), more = max(cut[k], cut[k + 1]);
      cut[k] = less;
      cut[k + 1] = more;
    }
  }
  return n;
}

HWY_INLINE void Scattering::panel(const GaussianPanels::Panel& p) {
  for (std::uint32_t n = p.passed.begin; n < p.passed.end && gaussians.with_depths; ++n) {
    const std::uint32_t met = panels.indices()[n];
    front += gaussians.depth_of(met, 1e15);
  }
  const Real from = p.begin, to = min(p.end, end);
  const Mask seen = !ray_ended(fma(from, a.extinction, front), most, max(max(sum[0], sum[1]), sum[2]));
  const Mask going = seen && (from < to);
  if (!any_lane(going)) {
    ++skipped_panels;
    return;
  }
  const Real last = select(going, to, from);
  const bool empty = p.active.begin == p.active.end;
  if (empty) closed_forms(p, from, last, going);
  if (p.samples == 0) return;
  Real cut[GaussianPanels::most_cuts + 2];
  const int n = cuts(p, from, last, cut);
  for (int k = 0; k + 1 < n; ++k) {
    if (!any_lane(cut[k] < cut[k + 1])) continue;
    if (!lit) {
      sample(p, cut[k], cut[k + 1]);
    } else {
      sample_lit(p, cut[k], cut[k + 1]);
    }
  }
}

}  // namespace

// One square of the tile, its upper left pixel at (x, y) in the tile.
static void gaussian_airlight(const GaussianAirlight& a, const TileView& view, const GaussianPanels& panels,
                              std::span<const GaussLegendre> rules, std::span<const GaussianTerms> terms,
                              std::span<const LitParts> lit, AlignedFloats& scratch, LitScratch& lit_scratch, int x, int y,
                              int side) {
  Scattering s(a, view, panels, rules, terms, scratch.resize(panels.met().size() * floats_a_gaussian), LitRays(lit, lit_scratch));
  const float* distance = view.plane(a.distance);
  const int first_column = x - x % lanes;
  const bool any_met = !panels.met().empty();
  StepCounts counts;
  for (int row = y; row < y + side; ++row) {
    for (int column = first_column; column < x + side; column += lanes) {
      const int i = row * tile_side + column;
      const Real across = first_lanes() + static_cast<double>(column - x);
      const Mask mine = across >= 0.0 && across < static_cast<double>(side);
      const Real length = select(mine, ray_length(load(distance + i), a.sky_distance), 0.0);
      const int begin = std::max(column, x);
      const auto pixels =
          static_cast<std::uint64_t>(view.in_image(row * tile_side + begin, std::min(column + lanes, x + side) - begin));
      if (side >= lanes && !any_lane(length > 0.0)) {
        store_no_airlight(a, view, i);
        counts.skipped += pixels;
        continue;
      }
      s.begin(i, mine, length);
      for (const GaussianPanels::Panel& p : panels.panels()) s.panel(p);
      if (!any_met) counts.skipped += pixels;
      counts.parts += panels.panels().size() * pixels;
      counts.skipped_parts += static_cast<std::uint64_t>(s.skipped_panels) * pixels;

      Real tau = optical_depth(length, a.extinction);
      for (std::uint32_t met = 0; met < panels.met().size(); ++met) {
        tau += s.gaussians.depth_of(met, s.end);
      }
      const Real source = opacity(tau);
      for (int c = 0; c < 3; ++c) s.put(fma(source, a.ambient[c], s.sum[c]), view.plane(a.airlight, c));
      s.put(transmittance(tau), view.plane(a.transmittance));
      if (a.optical_depth) s.put(min(tau, 1e30), view.plane(a.optical_depth));
    }
  }
  view.counts->add(counts);
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(gaussian_airlight);

void run_tile(const GaussianAirlight& a, const TileView& view, Simd simd, std::span<const LitParts> lit) {
  static_assert(tile_side % bin_side == 0);
  // Kept for their memory alone, but for the rules, of one node and more.
  thread_local GaussianPanels panels;
  thread_local std::vector<GaussLegendre> rules;
  thread_local std::vector<GaussianTerms> terms;
  thread_local AlignedFloats scratch;
  thread_local LitScratch lit_scratch;
  panels.begin(a);
  while (rules.size() < static_cast<std::size_t>(a.samples)) rules.emplace_back(static_cast<int>(rules.size()) + 1);
  terms.clear();
  for (const GaussianDensity& g : a.gaussians) {
    terms.push_back({1 / g.radius, f32::gaussian_whole(1, g.radius).v, f32::gaussian_whole(g.extinction, g.radius).v,
                     1 / std::max(g.extinction, 1e-37F)});
  }
  for (int y = 0; y < tile_side; y += bin_side) {
    for (int x = 0; x < tile_side; x += bin_side) {
      if (view.tile.x + x >= a.view.extent.width || view.tile.y + y >= a.view.extent.height) continue;  // never read
      const auto run = [&](int square_x, int square_y, int side) {
        entry(HWY_DISPATCH_TABLE(gaussian_airlight), simd)(a, view, panels, rules, terms, lit, scratch, lit_scratch,
                                                           square_x - view.tile.x, square_y - view.tile.y, side);
      };
      if (any_ray(view.plane(a.distance), x, y, bin_side)) {
        panels.each(view.tile.x + x, view.tile.y + y, bin_side, run);
      } else {
        run(view.tile.x + x, view.tile.y + y, bin_side);
      }
    }
  }
}

}  // namespace airlight
#endif
