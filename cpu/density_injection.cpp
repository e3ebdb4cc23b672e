#include <algorithm>
#include <cmath>
#include <vector>

#include "common/algorithms/voxel_table.h"
#include "cpu/halves.h"
#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/density_injection.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/medium.h"

#ifndef AIRLIGHT_CPU_DENSITY_INJECTION
#define AIRLIGHT_CPU_DENSITY_INJECTION
namespace airlight {

namespace {

// The cells of an axis that a Gaussian reaches, and where its shares of them begin.
struct Reached {
  int first = 0, count = 0;
  std::size_t at = 0;
};

}  // namespace

}  // namespace airlight
#endif

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

static void shares(const GaussianDensity& g, const Reached (&reached)[3], float cell, float* values) {
  for (int axis = 0; axis < 3; ++axis) {
    const Reached& r = reached[axis];
    const float first = (static_cast<float>(r.first) + 0.5F) * cell - g.center[axis];
    float* to = values + r.at;
    for (int i = 0; i < r.count; i += lanes) {  // there is room for the last lanes, which stay 0
      const Real at = first_lanes() + static_cast<float>(i);
      const Real share = injected_gaussian(1 / g.radius, fma(at, cell, first), cell);
      store(select(at < static_cast<float>(r.count), share, 0.0), to + i);
    }
  }
}

// A row of cells; with room for the last lanes behind.
static void add_row(float extinction, const float* shares, int count, float* row) {
  for (int i = 0; i < count; i += lanes) store(fma(load(shares + i), extinction, load(row + i)), row + i);
}

static void add_grid(const GridDensity& grid, const float* voxels, float x, float y, float z, float cell, int count, float* row) {
  const GridLookup lookup{&grid, voxels, voxels + bricks_at(grid)};
  for (int i = 0; i < count; i += lanes) {
    const Real3 p{fma(first_lanes() + static_cast<float>(i), cell, x), y, z};
    store(load(row + i) + lookup.extinction_at(p), row + i);
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(shares);
HWY_EXPORT(add_row);
HWY_EXPORT(add_grid);

namespace {

constexpr int padding = 16;  // the most lanes

Reached reached_of(const GaussianDensity& g, int axis, int cells, float cell) {
  const auto limit = [&](float x) { return static_cast<int>(std::clamp(std::floor(x), 0.0F, static_cast<float>(cells))); };
  const int first = limit((g.center[axis] - g.reach) / cell - 0.5F);
  const int end = limit((g.center[axis] + g.reach) / cell + 1.5F);
  return {first, std::max(end - first, 0), 0};
}

// The largest value that a lookup in each brick can meet.
void bound_bricks(const float* values, const int (&ring)[3], const int (&bricks)[3], int c, float* bounds) {
  for (int b = 0; b < bricks[1]; ++b) {
    for (int a = 0; a < bricks[0]; ++a) {
      float most = 0;
      for (int k = 4 * c; k < std::min(4 * c + 5, ring[2]); ++k) {
        for (int j = 4 * b; j < std::min(4 * b + 5, ring[1]); ++j) {
          const float* row = values + static_cast<std::ptrdiff_t>(ring[0]) * (j + static_cast<std::ptrdiff_t>(ring[1]) * k);
          for (int i = 4 * a; i < std::min(4 * a + 5, ring[0]); ++i) most = std::max(most, row[i]);
        }
      }
      bounds[a + bricks[0] * (b + bricks[1] * c)] = most;
    }
  }
}

}  // namespace

void run_volume(const DensityInjection& a, const BufferView& view, Workers& workers, Simd simd) {
  const int size[3] = {static_cast<int>(a.size.x), static_cast<int>(a.size.y), static_cast<int>(a.size.z)};
  const int ring[3] = {size[0] + 2, size[1] + 2, size[2] + 2};
  const int bricks[3] = {bricks_an_axis(size[0]), bricks_an_axis(size[1]), bricks_an_axis(size[2])};
  std::vector<float> packed;  // what becomes halves
  if (a.half_unit > 0) packed.resize(voxel_table_floats(glm::ivec3(a.size)));
  float* out = packed.empty() ? view.made(a.extinction) : packed.data();
  for (int axis = 0; axis < 3; ++axis) out[axis] = static_cast<float>(size[axis]);
  float* values = out + 3;
  const std::size_t layer = static_cast<std::size_t>(ring[0]) * static_cast<std::size_t>(ring[1]);

  struct Injected {
    Reached reached[3];
  };
  std::vector<Injected> injected(a.gaussians.size());
  std::size_t floats = 0;
  for (std::size_t g = 0; g < injected.size(); ++g) {
    for (int axis = 0; axis < 3; ++axis) {
      Reached& r = injected[g].reached[axis];
      r = reached_of(a.gaussians[g], axis, size[axis], a.cell);
      r.at = floats;
      floats += static_cast<std::size_t>(r.count + padding);
    }
  }
  StepCounts& counts = view.counts;
  counts.parts = injected.size() * static_cast<std::uint64_t>(size[0]) * static_cast<std::uint64_t>(size[1]) *
                 static_cast<std::uint64_t>(size[2]);
  counts.skipped_parts = counts.parts;
  for (const Injected& g : injected) {
    counts.skipped_parts -= static_cast<std::uint64_t>(g.reached[0].count) * static_cast<std::uint64_t>(g.reached[1].count) *
                            static_cast<std::uint64_t>(g.reached[2].count);
  }
  std::vector<float> share(floats);
  constexpr int batch = 64;
  const int all = static_cast<int>(injected.size());
  workers.each((all + batch - 1) / batch, [&](int n, int) {
    for (int g = n * batch; g < std::min((n + 1) * batch, all); ++g) {
      const auto i = static_cast<std::size_t>(g);
      entry(HWY_DISPATCH_TABLE(shares), simd)(a.gaussians[i], injected[i].reached, a.cell, share.data());
    }
  });

  std::vector<std::vector<float>> rows(static_cast<std::size_t>(workers.threads()));
  workers.each(ring[2], [&](int k, int worker) {
    float* slab = values + layer * static_cast<std::size_t>(k);
    std::fill(slab, slab + layer, 0.0F);
    if (k == 0 || k == ring[2] - 1) return;
    // Rows with room for the last lanes, cut when they are copied.
    const std::size_t stride = static_cast<std::size_t>(size[0] + padding);
    std::vector<float>& scratch = rows[static_cast<std::size_t>(worker)];
    scratch.assign(stride * static_cast<std::size_t>(size[1]), 0.0F);
    for (std::size_t g = 0; g < injected.size(); ++g) {
      const auto& [x, y, z] = injected[g].reached;
      const int at = k - 1 - z.first;
      if (at < 0 || at >= z.count || x.count == 0) continue;
      const float here = a.gaussians[g].extinction * share[z.at + static_cast<std::size_t>(at)];
      for (int j = 0; j < y.count; ++j) {
        float* row = scratch.data() + stride * static_cast<std::size_t>(y.first + j) + x.first;
        entry(HWY_DISPATCH_TABLE(add_row), simd)(here * share[y.at + static_cast<std::size_t>(j)], share.data() + x.at, x.count,
                                                 row);
      }
    }
    for (int j = 0; j < size[1]; ++j) {
      float* row = scratch.data() + stride * static_cast<std::size_t>(j);
      if (a.grid) {
        entry(HWY_DISPATCH_TABLE(add_grid), simd)(a.grid, view.floats(a.voxels), 0.5F * a.cell,
                                                  (static_cast<float>(j) + 0.5F) * a.cell,
                                                  (static_cast<float>(k) - 0.5F) * a.cell, a.cell, size[0], row);
      }
      std::copy(row, row + size[0], slab + static_cast<std::size_t>(ring[0]) * static_cast<std::size_t>(j + 1) + 1);
    }
  });

  float* bounds = values + layer * static_cast<std::size_t>(ring[2]);
  for (int axis = 0; axis < 3; ++axis) bounds[axis] = static_cast<float>(bricks[axis]);
  workers.each(bricks[2], [&](int c, int) { bound_bricks(values, ring, bricks, c, bounds + 3); });
  if (!packed.empty())
    pack_halves(packed, 3, voxel_values(glm::ivec3(a.size)), 1 / a.half_unit, view.made(a.extinction), workers);
}

}  // namespace airlight
#endif
