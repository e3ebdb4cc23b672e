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

// What the fill of one tile reads and writes. Rows are tile_side apart; a vector may reach past the end of a row, hence the padding.
struct VisibilityTile {
  Tile tile;
  const View* view;
  std::span<const TriangleChunk> chunks;
  const float *positions, *normals;
  const std::uint32_t* triangles;
  float *distance, *normal[3], *material;
  alignas(64) float nearness[tile_pixels + 16];    // 1/z, 0: nothing
  alignas(64) std::int32_t hit[tile_pixels + 16];  // triangle, -1: nothing
};

}  // namespace airlight
#endif

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

namespace {

// One edge on a row: q + a i + b j for the pixels of a vector. The part that varies within it stays below 2^29, so the rest, exact
// in 64 bits, may be held at 2^30 without changing its sign.
HWY_INLINE IntVec edge_values(std::int64_t at_first, IntVec across) {
  constexpr std::int64_t limit = std::int64_t{1} << 30;
  const auto held = static_cast<std::int32_t>(at_first < -limit ? -limit : at_first > limit ? limit : at_first);
  return hn::Add(hn::Set(Ints(), held), across);
}

void fill(const PixelTriangle& t, VisibilityTile& s) {
  const Floats df;
  const Ints di;
  const int x0 = HWY_MAX(t.x0 - s.tile.x, 0), x1 = HWY_MIN(t.x1 - s.tile.x, tile_side - 1);
  const int y0 = HWY_MAX(t.y0 - s.tile.y, 0), y1 = HWY_MIN(t.y1 - s.tile.y, tile_side - 1);
  const IntVec lane = hn::Iota(di, 0), none = hn::Set(di, -1);
  const IntVec across0 = hn::Mul(lane, hn::Set(di, t.a[0]));
  const IntVec across1 = hn::Mul(lane, hn::Set(di, t.a[1]));
  const IntVec across2 = hn::Mul(lane, hn::Set(di, t.a[2]));
  const IntVec id = hn::Set(di, static_cast<std::int32_t>(t.id));
  const Real kx = static_cast<float>(t.kx), kmin = t.kmin, kmax = t.kmax;
  const Real k_across = first_lanes() * kx;
  for (int y = y0; y <= y1; ++y) {
    const int j = s.tile.y + y;
    const double k_row = t.k0 + t.ky * j;
    for (int x = x0; x <= x1; x += lanes) {
      const int i = s.tile.x + x;
      const auto at = [&](int k) {
        return t.q[k] + static_cast<std::int64_t>(t.a[k]) * i + static_cast<std::int64_t>(t.b[k]) * j;
      };
      // All three are >= 0 where their bitwise or has no sign.
      const IntVec sides = hn::Or(edge_values(at(0), across0), hn::Or(edge_values(at(1), across1), edge_values(at(2), across2)));
      const auto covered = hn::And(hn::Gt(sides, none), hn::Gt(hn::Set(di, x1 - x + 1), lane));
      if (hn::AllFalse(di, covered)) continue;
      const int p = y * tile_side + x;
      const Real k = min(max(k_across + static_cast<float>(k_row + t.kx * i), kmin), kmax);
      const Real before = load(s.nearness + p);
      const auto nearer = hn::And(hn::RebindMask(df, covered), hn::Gt(k.v, before.v));
      hn::StoreU(hn::IfThenElse(nearer, k.v, before.v), df, s.nearness + p);
      hn::StoreU(hn::IfThenElse(hn::RebindMask(di, nearer), id, hn::LoadU(di, s.hit + p)), di, s.hit + p);
    }
  }
}

HWY_INLINE Real gather(const float* p, IntVec index, int offset) { return hn::GatherIndex(Floats(), p + offset, index); }
HWY_INLINE Real3 gather3(const float* p, IntVec index) { return {gather(p, index, 0), gather(p, index, 1), gather(p, index, 2)}; }

// Distance, normal and material of the triangle found on each pixel.
void resolve(const VisibilityTile& s) {
  const Ints di;
  const auto* corners = reinterpret_cast<const std::int32_t*>(s.triangles);
  for (int p = 0; p < tile_pixels; p += lanes) {
    const IntVec hit = hn::LoadU(di, s.hit + p);
    const auto found = hn::Gt(hit, hn::Set(di, -1));
    Real distance = 1e30, material = -1.0;
    Real3 n{0.0, 0.0, 0.0};
    if (!hn::AllFalse(di, found)) {
      const Mask seen{hn::RebindMask(Floats(), found)};
      const IntVec row = hn::ShiftLeft<2>(hn::Max(hit, hn::Zero(di)));  // a lane without a hit looks at the first triangle
      const IntVec three = hn::Set(di, 3);
      const IntVec ia = hn::Mul(hn::GatherIndex(di, corners, row), three);
      const IntVec ib = hn::Mul(hn::GatherIndex(di, corners + 1, row), three);
      const IntVec ic = hn::Mul(hn::GatherIndex(di, corners + 2, row), three);
      const Real3 a = gather3(s.positions, ia), b = gather3(s.positions, ib), c = gather3(s.positions, ic);
      const Real3 d = pixel_rays(*s.view, s.tile, p);
      Real at, wb, wc;
      ray_triangle(d.x, d.y, d.z, a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, at, wb, wc);
      const Real3 na = gather3(s.normals, ia), nb = gather3(s.normals, ib), nc = gather3(s.normals, ic);
      shading_normal(d.x, d.y, d.z, na.x, na.y, na.z, nb.x, nb.y, nb.z, nc.x, nc.y, nc.z, wb, wc, n.x, n.y, n.z);
      distance = select(seen, at, distance);
      n = {select(seen, n.x, 0.0), select(seen, n.y, 0.0), select(seen, n.z, 0.0)};
      material = select(seen, hn::ConvertTo(Floats(), hn::GatherIndex(di, corners + 3, row)), material);
    }
    store(distance, s.distance + p);
    store(n.x, s.normal[0] + p);
    store(n.y, s.normal[1] + p);
    store(n.z, s.normal[2] + p);
    store(material, s.material + p);
  }
}

}  // namespace

static void visibility_tile(VisibilityTile& s) {
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
  if (any) return resolve(s);
  for (int p = 0; p < tile_pixels; p += lanes) {
    store(Real(1e30), s.distance + p);
    for (float* n : s.normal) store(Real(0.0), n + p);
    store(Real(-1.0), s.material + p);
  }
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

void Rasteriser::prepare(const SurfaceVisibility& a, std::span<const float> positions, std::span<const float> normals,
                         std::span<const std::uint32_t> triangles, Simd simd, Workers& workers) {
  State& s = *state_;
  s.a = a;
  s.positions = positions;
  s.normals = normals;
  s.triangles = triangles;
  s.simd = simd;
  s.setup.run(a, positions, triangles, workers);
}

void Rasteriser::run_tile(Tile tile, float* distance, float* normal_x, float* normal_y, float* normal_z,
                          float* material) const {
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
  entry(HWY_DISPATCH_TABLE(visibility_tile), s.simd)(view);
}

}  // namespace airlight
#endif
