#include "cpu/surface_visibility.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/surface_visibility.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
#include "cpu/surface_visibility_setup.h"

#ifndef AIRLIGHT_CPU_SURFACE_VISIBILITY_CPP
#define AIRLIGHT_CPU_SURFACE_VISIBILITY_CPP
namespace airlight {

// What the fill of one tile reads and writes. Rows are tile_side apart; a vector may reach past the end of a row, hence the
// padding.
struct VisibilityTile {
  Tile tile;
  const View* view;
  std::span<const TriangleChunk> chunks;
  const float *positions, *normals;
  const std::uint32_t* triangles;
  float *distance, *normal[3], *material, *corners[3];
  alignas(64) float nearness[tile_pixels + 16];    // 1/z, 0: nothing
  alignas(64) std::int32_t hit[tile_pixels + 16];  // triangle, -1: nothing
};

}  // namespace airlight
#endif

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

namespace {

// What the lanes' part of an edge leaves: exact in 64 bits, and held at 2^30, which cannot change the sign of the sum, since the
// part that varies over the lanes stays below 2^29.
HWY_INLINE std::int32_t held(std::int64_t edge) {
  constexpr std::int64_t limit = std::int64_t{1} << 30;
  return static_cast<std::int32_t>(edge < -limit ? -limit : edge > limit ? limit : edge);
}

void fill(const PixelTriangle& t, VisibilityTile& s) {
  const Floats df;
  const Ints di;
  const int x0 = HWY_MAX(t.x0 - s.tile.x, 0), x1 = HWY_MIN(t.x1 - s.tile.x, tile_side - 1);
  const int y0 = HWY_MAX(t.y0 - s.tile.y, 0), y1 = HWY_MIN(t.y1 - s.tile.y, tile_side - 1);
  const int i = s.tile.x + x0, j = s.tile.y + y0;
  const IntVec lane = hn::Iota(di, 0), none = hn::Set(di, -1), id = hn::Set(di, static_cast<std::int32_t>(t.id));
  IntVec across[3];
  std::int64_t edge[3];
  for (int k = 0; k < 3; ++k) {
    across[k] = hn::Mul(lane, hn::Set(di, t.a[k]));
    edge[k] = t.q[k] + static_cast<std::int64_t>(t.a[k]) * i + static_cast<std::int64_t>(t.b[k]) * j;
  }
  // 1/z counts from the first pixel of the row, whatever the number of lanes: the same bits on every target.
  const Real kmin = t.kmin, kmax = t.kmax, kx = static_cast<float>(t.kx);
  for (int y = y0; y <= y1; ++y) {
    std::int64_t at[3] = {edge[0], edge[1], edge[2]};
    const Real k_row = static_cast<float>(t.k0 + t.kx * i + t.ky * (s.tile.y + y));
    for (int x = x0; x <= x1; x += lanes) {
      // All three are >= 0 where their bitwise or has no sign.
      const IntVec sides =
          hn::Or(hn::Add(hn::Set(di, held(at[0])), across[0]),
                 hn::Or(hn::Add(hn::Set(di, held(at[1])), across[1]), hn::Add(hn::Set(di, held(at[2])), across[2])));
      const auto covered = hn::And(hn::Gt(sides, none), hn::Gt(hn::Set(di, x1 - x + 1), lane));
      if (!hn::AllFalse(di, covered)) {
        const int p = y * tile_side + x;
        const Real k = min(max(fma(first_lanes() + (x - x0), kx, k_row), kmin), kmax);
        const Real before = load(s.nearness + p);
        const auto nearer = hn::And(hn::RebindMask(df, covered), hn::Gt(k.v, before.v));
        hn::StoreU(hn::IfThenElse(nearer, k.v, before.v), df, s.nearness + p);
        hn::StoreU(hn::IfThenElse(hn::RebindMask(di, nearer), id, hn::LoadU(di, s.hit + p)), di, s.hit + p);
      }
      for (int k = 0; k < 3; ++k) at[k] += static_cast<std::int64_t>(t.a[k]) * lanes;
    }
    for (int k = 0; k < 3; ++k) edge[k] += t.b[k];
  }
}

// The corners of each lane's triangle: positions and normals of a, b, c, and its material.
struct LaneTriangles {
  Real position[9], normal[9], material;
};

// Neighbouring pixels mostly see the same triangle: each different one is read once, for all lanes that see it.
HWY_INLINE LaneTriangles lane_triangles(const VisibilityTile& s, const std::int32_t* hits) {
  const Ints di;
  const IntVec hit = hn::LoadU(di, hits);
  LaneTriangles found;
  for (int k = 0; k < 9; ++k) found.position[k] = 1.0, found.normal[k] = 0.0;
  found.material = -1.0;
  auto waiting = hn::Gt(hit, hn::Set(di, -1));
  while (!hn::AllFalse(di, waiting)) {
    const std::int32_t first = hits[hn::FindFirstTrue(di, waiting)];
    const auto same = hn::Eq(hit, hn::Set(di, first));
    const Mask here{hn::RebindMask(Floats(), same)};
    const std::uint32_t* corners = s.triangles + static_cast<std::ptrdiff_t>(first) * 4;
    for (int corner = 0; corner < 3; ++corner) {
      const float* p = s.positions + static_cast<std::ptrdiff_t>(corners[corner]) * 3;
      const float* n = s.normals + static_cast<std::ptrdiff_t>(corners[corner]) * 3;
      for (int c = 0; c < 3; ++c) {
        found.position[corner * 3 + c] = select(here, p[c], found.position[corner * 3 + c]);
        found.normal[corner * 3 + c] = select(here, n[c], found.normal[corner * 3 + c]);
      }
    }
    found.material = select(here, static_cast<float>(corners[3]), found.material);
    waiting = hn::AndNot(same, waiting);
  }
  return found;
}

// Distance, normal and material of the triangle found on each pixel.
void resolve(const VisibilityTile& s) {
  for (int i = 0; i < tile_pixels; i += lanes) {
    const Mask seen{hn::RebindMask(Floats(), hn::Gt(hn::LoadU(Ints(), s.hit + i), hn::Set(Ints(), -1)))};
    Real distance = 1e30, material = -1.0, corners[3] = {0.0, 0.0, 0.0};
    Real3 n{0.0, 0.0, 0.0};
    if (any_lane(seen)) {
      const LaneTriangles t = lane_triangles(s, s.hit + i);
      const Real *p = t.position, *q = t.normal;
      const Real3 d = pixel_rays(*s.view, s.tile, i);
      Real at, wb, wc;
      ray_triangle(d.x, d.y, d.z, p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8], at, wb, wc);
      shading_normal(d.x, d.y, d.z, q[0], q[1], q[2], q[3], q[4], q[5], q[6], q[7], q[8], wb, wc, n.x, n.y, n.z);
      distance = select(seen, at, distance);
      n = {select(seen, n.x, 0.0), select(seen, n.y, 0.0), select(seen, n.z, 0.0)};
      material = t.material;
      if (s.corners[0]) {
        const Real side = seen_side(d.x, d.y, d.z, q[0], q[1], q[2], q[3], q[4], q[5], q[6], q[7], q[8], wb, wc);
        const Real number = Real(hn::ConvertTo(Floats(), hn::LoadU(Ints(), s.hit + i))) + 1.0;
        corners[0] = number * side;
        corners[1] = select(seen, wb, 0.0);
        corners[2] = select(seen, wc, 0.0);
      }
    }
    store(distance, s.distance + i);
    store(n.x, s.normal[0] + i);
    store(n.y, s.normal[1] + i);
    store(n.z, s.normal[2] + i);
    store(material, s.material + i);
    if (!s.corners[0]) continue;
    for (int k = 0; k < 3; ++k) store(corners[k], s.corners[k] + i);
  }
}

}  // namespace

static bool visibility_tile(VisibilityTile& s) {
  bool any = false;
  for (const TriangleChunk& chunk : s.chunks) {
    const auto members = chunk.of_tile(static_cast<std::uint32_t>(s.tile.index));
    if (!any && !members.empty()) {
      any = true;
      for (int p = 0; p < tile_pixels; p += lanes) {
        store(Real(0.0), s.nearness + p);
        hn::StoreU(hn::Set(Ints(), -1), Ints(), s.hit + p);
      }
    }
    for (const std::uint32_t member : members) fill(chunk.triangles[member], s);
  }
  if (any) {
    resolve(s);
    return true;
  }
  for (int p = 0; p < tile_pixels; p += lanes) {
    store(Real(1e30), s.distance + p);
    for (float* n : s.normal) store(Real(0.0), n + p);
    store(Real(-1.0), s.material + p);
    if (!s.corners[0]) continue;
    for (float* c : s.corners) store(Real(0.0), c + p);
  }
  return false;
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(visibility_tile);

struct Rasteriser::State {
  SurfaceVisibility a;
  std::span<const float> positions, normals;
  std::span<const std::uint32_t> triangles;
  Simd simd = Simd::scalar;
  TriangleSetup setup;
};

Rasteriser::Rasteriser() : state_(std::make_unique<State>()) {}
Rasteriser::~Rasteriser() = default;

StepCounts Rasteriser::prepare(const SurfaceVisibility& a, Rows rows, std::span<const float> positions,
                               std::span<const float> normals, std::span<const std::uint32_t> triangles, Simd simd,
                               Workers& workers) {
  State& s = *state_;
  s.a = a;
  s.positions = positions;
  s.normals = normals;
  s.triangles = triangles;
  s.simd = simd;
  s.setup.run(a, rows, positions, triangles, workers);
  StepCounts counts;
  counts.parts = triangles.size() / 4;
  for (const TriangleChunk& chunk : s.setup.chunks()) counts.skipped_parts += chunk.dropped;
  return counts;
}

bool Rasteriser::run_tile(Tile tile, float* distance, float* normal_x, float* normal_y, float* normal_z, float* material,
                          float* const* corners) const {
  const State& s = *state_;
  VisibilityTile view;  // 32 KiB on the stack, written before it is read
  view.tile = tile;
  view.view = &s.a.view;
  view.chunks = s.setup.chunks();
  view.positions = s.positions.data();
  view.normals = s.normals.data();
  view.triangles = s.triangles.data();
  view.distance = distance;
  view.normal[0] = normal_x;
  view.normal[1] = normal_y;
  view.normal[2] = normal_z;
  view.material = material;
  for (int k = 0; k < 3; ++k) view.corners[k] = corners ? corners[k] : nullptr;
  return entry(HWY_DISPATCH_TABLE(visibility_tile), s.simd)(view);
}

}  // namespace airlight
#endif
