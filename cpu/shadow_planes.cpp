#include "cpu/shadow_planes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/shadow_planes.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

namespace {

// A ScreenFunction over one tile. Its value at a pixel is rounded once where the row begins and once at the pixel, counted from
// the tile's corner: the same bits on every target, and errors of 1e-7 of what the function varies over a tile.
struct OnTile {
  double at_corner, down;
  float across;

  OnTile(const ScreenFunction& f, const Tile& tile)
      : at_corner(f.c[0] + f.c[1] * tile.x + f.c[2] * tile.y), down(f.c[2]), across(static_cast<float>(f.c[1])) {}
  float row(int y) const { return static_cast<float>(at_corner + down * y); }
};

// Columns of each row outside of which f is surely negative.
HWY_INLINE void narrow(const OnTile& f, Real row, Real& from, Real& to) {
  const auto corner = static_cast<float>(f.at_corner), down = static_cast<float>(f.down);
  const Real value = fma(row, down, corner);
  const float scale = std::fabs(corner) + static_cast<float>(tile_side) * (std::fabs(down) + std::fabs(f.across));
  const Real most = value + scale * 1e-6F;
  if (std::fabs(f.across) > 1e-9F * scale) {
    const Real bound = most * (-1 / f.across);
    if (f.across > 0) {
      from = max(from, bound - 0.01);
    } else {
      to = min(to, bound + 0.01);
    }
  } else {
    to = select(most < -1e-6F * scale, -1.0, to);
  }
}

// Crossings of one plane with the rays of the tile. `ends`: 1/z of the rays' ends.
void cross(const ShadowQuad& q, const Tile& tile, const float* ends, float least_end, Crossings& c) {
  const Floats df;
  const hn::RebindToUnsigned<Floats> du;
  const OnTile u(q.u, tile), v(q.v, tile), e(q.e, tile), k(q.k, tile);
  // Behind every surface of the tile, or the ray's beginning.
  const float k_most = static_cast<float>(std::max(k.at_corner, k.at_corner + k.down * (tile_side - 1))) +
                       std::max(k.across, 0.0F) * static_cast<float>(tile_side - 1);
  if (!(k_most * 1.0001F > least_end)) return;

  HWY_ALIGN float first[tile_side], last[tile_side];
  const OnTile minus_v({-q.v.c[0], -q.v.c[1], -q.v.c[2]}, tile),
      beyond({q.k.c[0] - static_cast<double>(least_end) * 0.9999, q.k.c[1], q.k.c[2]}, tile);
  for (int y = 0; y < tile_side; y += lanes) {
    const Real row = first_lanes() + y;
    Real from = 0.0, to = static_cast<float>(tile_side - 1);
    narrow(u, row, from, to);
    narrow(minus_v, row, from, to);
    narrow(e, row, from, to);
    narrow(beyond, row, from, to);
    store(from, first + y);
    store(to, last + y);
  }

  if (c.k.size() < c.count + tile_pixels + tile_side) {
    c.k.resize(c.k.size() * 2 + 2 * tile_pixels);
    c.where.resize(c.k.size());
  }
  const auto tag = (static_cast<std::uint32_t>(q.change) + Crossings::change_offset) * static_cast<std::uint32_t>(tile_pixels);
  const Real zero = 0.0;
  for (int y = 0; y < tile_side; ++y) {
    if (!(first[y] <= last[y])) continue;
    const int x0 = static_cast<int>(first[y]), x1 = std::min(static_cast<int>(last[y]) + 1, tile_side - 1);
    const Real row_u = u.row(y), row_v = v.row(y), row_e = e.row(y), row_k = k.row(y);
    for (int x = x0; x <= x1; x += lanes) {
      const Real column = first_lanes() + x;
      const Real at = fma(column, k.across, row_k);
      const int pixel = y * tile_side + x;
      const Mask here = (fma(column, u.across, row_u) >= zero) && (fma(column, v.across, row_v) < zero) &&
                        (fma(column, e.across, row_e) >= zero) && (at > load(ends + pixel)) &&
                        (column < static_cast<float>(x1 + 1));
      if (!any_lane(here)) continue;
      const auto where = hn::Add(hn::Iota(du, static_cast<std::uint32_t>(pixel)), hn::Set(du, tag));
      const std::size_t n = hn::CompressStore(at.v, here.m, df, c.k.data() + c.count);
      hn::CompressStore(where, hn::RebindMask(du, here.m), du, c.where.data() + c.count);
      c.count += n;
    }
  }
}

}  // namespace

// Lengths of the rays and the 1/z at which they end. Returns the least of these.
static float shadow_rays(const View& camera, const float* distance, float sky_distance, const Tile& tile, Crossings& c) {
  float* rays = c.rays.resize(3 * tile_pixels + tile_side);
  Real least = 1e30F;
  for (int i = 0; i < tile_pixels; i += lanes) {
    const Real length = ray_length(load(distance + i), sky_distance);
    const Real3 d = pixel_rays(camera, tile, i);
    const Real slant = 1.0 / dot(d, real3(camera.forward));  // length over z
    const Real end = slant / max(length, 1e-30);
    store(length, rays + i);
    store(slant, rays + tile_pixels + i);
    store(end, rays + 2 * tile_pixels + i);
    // What lies outside the image is not read; it may be anything.
    const int x = tile.x + i % tile_side, y = tile.y + i / tile_side;
    const Mask inside = (first_lanes() + static_cast<float>(x) < static_cast<float>(camera.extent.width)) &&
                        (Real(static_cast<float>(y)) < static_cast<float>(camera.extent.height));
    least = select(inside, min(least, end), least);
  }
  HWY_ALIGN float lane[lanes];
  store(least, lane);
  return *std::min_element(lane, lane + lanes);
}

static void shadow_cross(std::span<const ShadowQuads> chunks, const Tile& tile, float least_end, Crossings& c) {
  c.count = 0;
  const float* ends = c.rays.data() + 2 * static_cast<std::ptrdiff_t>(tile_pixels);
  for (const ShadowQuads& chunk : chunks) {
    for (const std::uint32_t i : chunk.of_tile(static_cast<std::size_t>(tile.index)))
      cross(chunk.quads[i], tile, ends, least_end, c);
  }
}

// Single scattering of one light over the lit parts of every ray; `whole`: no plane touches the tile, every ray is lit
// throughout. A part that ends before it begins counts negative: the published order has such.
static void shadow_scatter(const ShadowPlanes& a, const TileView& view, std::size_t index, bool whole, const Crossings& c) {
  const Light& light = a.lights[index];
  const float* tables = a.tables ? view.floats(a.tables) : nullptr;
  const int kind = static_cast<int>(a.phase.kind);
  const auto g = static_cast<float>(a.phase.g);
  const bool published = a.order == ShadowOrder::published;
  float* scattered = view.plane(a.scattered, 0, static_cast<int>(index));
  HWY_ALIGN float from[lanes], to[lanes];
  for (int i = 0; i < tile_pixels; i += lanes) {
    std::uint32_t parts = whole ? 1 : 0;
    if (!whole) {
      const std::uint32_t* first = c.first_part.data() + i;
      for (int lane = 0; lane < lanes; ++lane) parts = std::max(parts, first[lane + 1] - first[lane]);
    }
    Real sum = 0.0;
    if (parts > 0 && a.extinction > 0) {
      const Real3 d = pixel_rays(a.view, view.tile, i);
      Real foot = 0.0, h = 1.0;
      if (!light.directional) {
        beside_ray(light, d, foot, h);
      }
      const Real mu = -dot(real3(light.vector), d);
      const Real length = load(c.rays.data() + i);
      for (std::uint32_t k = 0; k < parts; ++k) {
        Real x0 = 0.0, x1 = length;
        if (!whole) {
          const std::uint32_t* first = c.first_part.data() + i;
          for (int lane = 0; lane < lanes; ++lane) {
            const std::uint32_t part = first[lane] + k;
            const bool there = part < first[lane + 1];
            from[lane] = there ? c.from[part] : 0;
            to[lane] = there ? c.to[part] : 0;
          }
          x0 = load(from);
          x1 = load(to);
        }
        Real sign = 1.0;
        if (published) {
          const Real farther = max(x0, x1);
          sign = select(x1 < x0, -1.0, 1.0);
          x0 = min(x0, x1);
          x1 = farther;
        }
        const Mask there = x0 < x1;
        x1 = select(there, x1, x0);
        const Real once = light.directional ? directional_airlight(kind, g, a.extinction, mu, x0, x1)
                                            : point_airlight(tables, kind, g, a.extinction, foot, h, x0, x1);
        sum += select(there, sign * once, 0.0);
      }
    }
    store(sum, scattered + i);
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(shadow_rays);
HWY_EXPORT(shadow_cross);
HWY_EXPORT(shadow_scatter);

namespace {

constexpr std::size_t chunk_size = 1024;  // edges

void fill(float* values, float v) { std::fill(values, values + tile_pixels, v); }

}  // namespace

struct ShadowRasteriser::State {
  struct Worker {
    Crossings crossings;
    std::vector<LitParts> lit;
  };
  struct Job {
    LightVolumes* light;
    std::size_t chunk, first;
    const ShadowLight* from;
  };
  std::vector<Job> jobs;  // of one prepare(), kept for their memory
  std::vector<LightVolumes> lights;
  mutable std::vector<Worker> workers;
  Simd simd = Simd::scalar;
};

ShadowRasteriser::ShadowRasteriser() : state_(std::make_unique<State>()) {}
ShadowRasteriser::~ShadowRasteriser() = default;

void ShadowRasteriser::prepare(const View& view, Rows rows, std::size_t lights, std::span<const std::byte> bytes, Simd simd,
                               Workers& workers) {
  State& s = *state_;
  s.simd = simd;
  s.workers.resize(static_cast<std::size_t>(workers.threads()));
  const ShadowVolumesView volumes(bytes, lights);
  s.lights.resize(lights);
  std::vector<State::Job>& jobs = s.jobs;
  jobs.clear();
  for (std::size_t i = 0; i < lights; ++i) {
    LightVolumes& light = s.lights[i];
    const std::size_t edges = volumes.of(volumes.lights[i]).size();
    light.covering = volumes.lights[i].covering;
    light.used = (edges + chunk_size - 1) / chunk_size;
    if (light.chunks.size() < light.used) light.chunks.resize(light.used);
    for (std::size_t k = 0; k < light.used; ++k) jobs.push_back({&light, k, k * chunk_size, &volumes.lights[i]});
  }
  const ScreenRays rays(view);
  const auto make = [&](int j, int) {
    const State::Job& job = jobs[static_cast<std::size_t>(j)];
    const std::span<const ShadowEdge> all = volumes.of(*job.from);
    job.light->chunks[job.chunk].make(rays, *job.from, all.subspan(job.first, std::min(chunk_size, all.size() - job.first)),
                                      tile_side, rows);
  };
  workers.each(static_cast<int>(jobs.size()), std::cref(make));  // not copied, which would allocate
}

void ShadowRasteriser::run_tile(const ShadowPlanes& a, const TileView& view, int worker) const {
  const State& s = *state_;
  Crossings& c = s.workers[static_cast<std::size_t>(worker)].crossings;
  const float least_end =
      entry(HWY_DISPATCH_TABLE(shadow_rays), s.simd)(a.view, view.plane(a.distance), a.sky_distance, view.tile, c);
  const int pixels = view.in_image(0, 0, tile_side);
  std::size_t met = 0;  // of the lights
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    const LightVolumes& light = s.lights[i];
    float* lit = view.plane(a.light_transmittance, 0, static_cast<int>(i));
    float* scattered = view.plane(a.scattered, 0, static_cast<int>(i));
    entry(HWY_DISPATCH_TABLE(shadow_cross), s.simd)(light.all(), view.tile, least_end, c);
    if (c.count == 0) {  // one answer for the whole tile
      const bool covered = light.covering > 0;
      if (lit) fill(lit, covered ? 0.0F : 1.0F);
      if (scattered && covered) fill(scattered, 0.0F);
      if (scattered && !covered) entry(HWY_DISPATCH_TABLE(shadow_scatter), s.simd)(a, view, i, true, c);
      continue;
    }
    ++met;
    by_pixel(c);
    if (a.order == ShadowOrder::published) {
      find_published_parts(c, light.covering, lit);
    } else {
      sort_by_distance(c);
      find_parts(c, light.covering, lit);
    }
    if (scattered) entry(HWY_DISPATCH_TABLE(shadow_scatter), s.simd)(a, view, i, false, c);
  }
  if (met == 0) view.skip(pixels);
  view.counts->parts += a.lights.size() * static_cast<std::uint64_t>(pixels);
  view.counts->skipped_parts += (a.lights.size() - met) * static_cast<std::uint64_t>(pixels);
}

std::span<const LitParts> ShadowRasteriser::lit_parts(const View& camera, const Image& distance, float sky_distance,
                                                      const TileView& view, int worker) const {
  const State& s = *state_;
  Crossings& c = s.workers[static_cast<std::size_t>(worker)].crossings;
  std::vector<LitParts>& lit = s.workers[static_cast<std::size_t>(worker)].lit;
  lit.resize(s.lights.size());
  const float least_end =
      entry(HWY_DISPATCH_TABLE(shadow_rays), s.simd)(camera, view.plane(distance), sky_distance, view.tile, c);
  bool any_dark = false;
  for (std::size_t i = 0; i < s.lights.size(); ++i) {
    const LightVolumes& light = s.lights[i];
    entry(HWY_DISPATCH_TABLE(shadow_cross), s.simd)(light.all(), view.tile, least_end, c);
    lit[i].rays = light.covering > 0 ? LitParts::Rays::dark : LitParts::Rays::lit;
    if (c.count > 0) {
      by_pixel(c);
      sort_by_distance(c);
      find_parts(c, light.covering, nullptr);
      lit[i].rays = LitParts::Rays::mixed;
      lit[i].from.swap(c.from);
      lit[i].to.swap(c.to);
      lit[i].first_part.swap(c.first_part);
    }
    any_dark |= lit[i].rays != LitParts::Rays::lit;
  }
  return any_dark ? std::span<const LitParts>(lit) : std::span<const LitParts>();
}

}  // namespace airlight
#endif
