#include "cpu/network_scatter.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/network_scatter.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/network.h"
//
#include "cpu/network_wide.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

namespace {

// 16 sums each, so that lanes of any number add in the same order.
struct WideChange {
  Wide change, sum;
  HWY_INLINE void add(int q, Real before, Real now) {
    change.v[q] += abs(now - before);
    sum.v[q] += now;
  }
  HWY_INLINE SourceChange total() const {
    HWY_ALIGN float values[2][16];
    wide_store(change, values[0]);
    wide_store(sum, values[1]);
    SourceChange all;
    for (int i = 0; i < 16; ++i) all.add({static_cast<double>(values[0][i]), static_cast<double>(values[1][i])});
    return all;
  }
};

}  // namespace

// Phase function from the lines' directions to that of line i, halves of the sum and of the difference of both ways.
static void phase_row_lanes(const Phase& phase, const std::int32_t* lines, int count, int i, float* even, float* odd) {
  const Real3 to = line_direction_of(lines + static_cast<std::ptrdiff_t>(line_fields) * i);
  for (int l = 0; l < count; ++l) {
    const Real mu = dot(line_direction_of(lines + static_cast<std::ptrdiff_t>(line_fields) * l), to);
    const auto kind = static_cast<int>(phase.kind);
    const auto g = static_cast<float>(phase.g);
    const Real along = phase_value(kind, g, mu), against = phase_value(kind, g, -mu);
    HWY_ALIGN float value[2][16];
    store(0.5 * (along + against), value[0]);
    store(0.5 * (along - against), value[1]);
    even[l] = value[0][0];
    odd[l] = value[1][0];
  }
}

// New sources of elements begin .. end, multiples of 16.
static void scatter_evenly_lanes(const EvenScatter& s, std::size_t begin, std::size_t end, SourceChange& change) {
  WideChange all{wide_zero(), wide_zero()};
  for (std::size_t e = begin; e < end; e += 16) {
    for (int q = 0; q < wide_vectors; ++q) {
      const std::size_t at = e + static_cast<std::size_t>(q) * lanes;
      Real sum = load(s.taken[0] + at);
      for (std::size_t g = 1; g < line_groups; ++g) sum += load(s.taken[g] + at);
      const Real now = fma(sum, load(s.factor + at), load(s.first + at));
      all.add(q, load(s.sources + at), now);
      store(now, s.sources + at);
    }
  }
  change = all.total();
}

// What particles have taken of both ways of a line, times share and albedo: even and odd part, of floats 0 .. row.
static void split_taken_lanes(const float* along, const float* against, const float* share, const float* albedo, std::size_t row,
                              float* even, float* odd) {
  for (std::size_t e = 0; e < row; e += 16) {
    const Wide shares = each_list(share + e / 4), albedos = wide_load(albedo + e), a = wide_load(along + e),
               b = wide_load(against + e);
    Wide sum, difference;
    for (int q = 0; q < wide_vectors; ++q) {
      const Real factor = shares.v[q] * albedos.v[q], x = factor * a.v[q], y = factor * b.v[q];
      sum.v[q] = x + y;
      difference.v[q] = x - y;
    }
    wide_store(sum, even + e);
    wide_store(difference, odd + e);
  }
}

namespace {

// `rows` rows of the product of a matrix, transposed, and what `lanes` particles take: [row][channel] of a vector each.
template <int rows>
HWY_INLINE void product(const float* matrix, std::size_t lines, const float* taken, Real (&sum)[rows][3]) {
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < 3; ++c) sum[r][c] = 0.0;
  }
  for (std::size_t l = 0; l < lines; ++l) {
    const Real x[3] = {load(taken), load(taken + lanes), load(taken + 2 * lanes)};
    for (int r = 0; r < rows; ++r) {
      const Real m = matrix[r];
      for (int c = 0; c < 3; ++c) sum[r][c] = fma(m, x[c], sum[r][c]);
    }
    taken += 3 * lanes;
    matrix += lines;
  }
}

HWY_INLINE void interleaved(const float* p, Real (&rgb)[3]) {
  Vec unused;
  hn::LoadInterleaved4(Floats(), p, rgb[0].v, rgb[1].v, rgb[2].v, unused);
}

struct LaneChange {
  Real change[3], sum[3];
};

// New sources of `lanes` particles from float `at` of a row on, in both ways of lines i .. i + rows.
template <int rows>
HWY_INLINE void new_sources(const DirectionScatter& s, const ScatterScratch& scratch, std::size_t at, std::size_t i,
                            LaneChange& change) {
  Real even[rows][3], odd[rows][3];
  product<rows>(s.even + i, s.lines, scratch.even.data(), even);
  HWY_ALIGN float kept[rows * 3 * lanes];  // registers hold one product
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < 3; ++c) store(even[r][c], kept + (3 * r + c) * lanes);
  }
  product<rows>(s.odd + i, s.odd_lines, scratch.odd.data(), odd);
  for (int r = 0; r < rows; ++r) {
    for (int way = 0; way < 2; ++way) {
      const std::size_t place = s.row * (2 * (i + static_cast<std::size_t>(r)) + static_cast<std::size_t>(way)) + at;
      Real first[3], before[3], now[3];
      interleaved(s.first + place, first);
      interleaved(s.sources + place, before);
      for (int c = 0; c < 3; ++c) {
        Real sum = load(kept + (3 * r + c) * lanes) + load(scratch.evenly + c * lanes);
        sum = way == 0 ? sum + odd[r][c] : sum - odd[r][c];
        now[c] = first[c] + sum;
        change.change[c] += abs(now[c] - before[c]);
        change.sum[c] += now[c];
      }
      hn::StoreInterleaved4(now[0].v, now[1].v, now[2].v, Real(0.0).v, Floats(), s.sources + place);
    }
  }
}

}  // namespace

// New sources of the 16 particles from number `particle` on.
static void scatter_directions_lanes(const DirectionScatter& s, std::size_t particle, ScatterScratch& scratch,
                                     SourceChange& change) {
  constexpr int rows = lanes == 16 ? most_rows : most_rows / 2;  // as many sums as there are registers for
  HWY_ALIGN float changes[2][3][16];
  for (std::size_t part = 0; part < particle_padding; part += lanes) {
    const std::size_t at = 4 * (particle + part);
    Real evenly[3] = {0.0, 0.0, 0.0};
    for (std::size_t l = 0; l < s.lines; ++l) {
      Real even[3], odd[3];
      interleaved(s.even_taken + s.row * l + at, even);
      interleaved(s.odd_taken + s.row * l + at, odd);
      for (std::size_t c = 0; c < 3; ++c) {
        store(even[c], scratch.even.data() + (3 * l + c) * lanes);
        store(odd[c], scratch.odd.data() + (3 * l + c) * lanes);
        evenly[c] = fma(load(s.rest + s.row / 4 * l + at / 4), even[c], evenly[c]);
      }
    }
    for (int c = 0; c < 3; ++c) store(evenly[c], scratch.evenly + c * lanes);
    LaneChange all{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    std::size_t i = 0;
    for (; i + rows <= s.lines; i += rows) new_sources<rows>(s, scratch, at, i, all);
    for (; i < s.lines; ++i) new_sources<1>(s, scratch, at, i, all);
    for (int c = 0; c < 3; ++c) {
      store(all.change[c], changes[0][c] + part);
      store(all.sum[c], changes[1][c] + part);
    }
  }
  change = {};
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < particle_padding; ++k)
      change.add({static_cast<double>(changes[0][c][k]), static_cast<double>(changes[1][c][k])});
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(phase_row_lanes);
HWY_EXPORT(scatter_evenly_lanes);
HWY_EXPORT(split_taken_lanes);
HWY_EXPORT(scatter_directions_lanes);

void phase_row(const Phase& phase, const std::int32_t* lines, int count, int i, float* even, float* odd, Simd simd) {
  entry(HWY_DISPATCH_TABLE(phase_row_lanes), simd)(phase, lines, count, i, even, odd);
}

SourceChange scatter_evenly(const EvenScatter& s, std::size_t begin, std::size_t end, Simd simd) {
  SourceChange change;
  entry(HWY_DISPATCH_TABLE(scatter_evenly_lanes), simd)(s, begin, end, change);
  return change;
}

void split_taken(const float* along, const float* against, const float* share, const float* albedo, std::size_t row, float* even,
                 float* odd, Simd simd) {
  entry(HWY_DISPATCH_TABLE(split_taken_lanes), simd)(along, against, share, albedo, row, even, odd);
}

SourceChange scatter_directions(const DirectionScatter& s, std::size_t particle, ScatterScratch& scratch, Simd simd) {
  SourceChange change;
  entry(HWY_DISPATCH_TABLE(scatter_directions_lanes), simd)(s, particle, scratch, change);
  return change;
}

}  // namespace airlight
#endif
