#include <algorithm>
#include <cmath>
#include <vector>

#include "cpu/kernels.h"
#include "cpu/network_links.h"
#include "cpu/network_sweep.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/network_iteration.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/network.h"
//
#include "cpu/network_wide.h"

#ifndef AIRLIGHT_CPU_NETWORK_ITERATION
#define AIRLIGHT_CPU_NETWORK_ITERATION
namespace airlight {

namespace {

constexpr int padding = 16;         // particles: the most lanes
constexpr std::size_t groups = 16;  // of lines, whatever the number of threads: sums over them have a fixed order
constexpr std::size_t batch = 64;   // particles

// Sums over sources, in an order that depends on neither threads nor lanes.
struct Change {
  double change = 0, sum = 0;
  void add(const Change& other) {
    change += other.change;
    sum += other.sum;
  }
};

// Of an isotropic phase function: rgb and an unused float a particle.
struct EvenScatter {
  const float* taken[groups];
  const float *factor, *first;
  float* sources;
};

// Both ways of a line have the same even part of what they send and the opposite odd one, and so has what they take: two matrices
// a quarter as large do for that from each direction to each. Tables are of `lines` rows of `row` floats; sources and first of
// twice as many.
struct Scatter {
  const float *even, *odd;  // [from line][to line]; no odd where it is zero
  const float *even_taken, *odd_taken;
  const float* first;
  float* sources;
  std::size_t lines, row;
};

constexpr int most_rows = 8;  // of the product, made at a time
struct ScatterScratch {
  std::vector<float> even, odd;  // what `lanes` particles take
};

}  // namespace

}  // namespace airlight
#endif

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
  HWY_INLINE Change total() const {
    HWY_ALIGN float values[2][16];
    wide_store(change, values[0]);
    wide_store(sum, values[1]);
    Change all;
    for (int i = 0; i < 16; ++i) all.add({static_cast<double>(values[0][i]), static_cast<double>(values[1][i])});
    return all;
  }
};

}  // namespace

// Phase function from the lines' directions to that of line i, halves of the sum and of the difference of both ways.
static void phase_row(const Phase& phase, const std::int32_t* lines, int count, int i, float* even, float* odd) {
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
static void scatter_evenly(const EvenScatter& s, std::size_t begin, std::size_t end, Change& change) {
  WideChange all{wide_zero(), wide_zero()};
  for (std::size_t e = begin; e < end; e += 16) {
    for (int q = 0; q < wide_vectors; ++q) {
      const std::size_t at = e + static_cast<std::size_t>(q) * lanes;
      Real sum = load(s.taken[0] + at);
      for (std::size_t g = 1; g < groups; ++g) sum += load(s.taken[g] + at);
      const Real now = fma(sum, load(s.factor + at), load(s.first + at));
      all.add(q, load(s.sources + at), now);
      store(now, s.sources + at);
    }
  }
  change = all.total();
}

// What particles have taken of both ways of a line, times share and albedo: even and odd part, of floats 0 .. row.
static void split_taken(const float* along, const float* against, const float* share, const float* albedo, std::size_t row,
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
HWY_INLINE void new_sources(const Scatter& s, const ScatterScratch& scratch, std::size_t at, std::size_t i, LaneChange& change) {
  Real even[rows][3], odd[rows][3];
  product<rows>(s.even + i, s.lines, scratch.even.data(), even);
  HWY_ALIGN float kept[rows * 3 * lanes];  // registers hold one product
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < 3; ++c) store(even[r][c], kept + (3 * r + c) * lanes);
  }
  if (s.odd) product<rows>(s.odd + i, s.lines, scratch.odd.data(), odd);
  for (int r = 0; r < rows; ++r) {
    for (int way = 0; way < 2; ++way) {
      const std::size_t place = s.row * (2 * (i + static_cast<std::size_t>(r)) + static_cast<std::size_t>(way)) + at;
      Real first[3], before[3], now[3];
      interleaved(s.first + place, first);
      interleaved(s.sources + place, before);
      for (int c = 0; c < 3; ++c) {
        Real sum = load(kept + (3 * r + c) * lanes);
        if (s.odd) sum = way == 0 ? sum + odd[r][c] : sum - odd[r][c];
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
static void scatter_directions(const Scatter& s, std::size_t particle, ScatterScratch& scratch, Change& change) {
  constexpr int rows = lanes == 16 ? most_rows : most_rows / 2;  // as many sums as there are registers for
  HWY_ALIGN float changes[2][3][16];
  for (std::size_t part = 0; part < padding; part += lanes) {
    const std::size_t at = 4 * (particle + part);
    for (std::size_t l = 0; l < s.lines; ++l) {
      Real even[3], odd[3];
      interleaved(s.even_taken + s.row * l + at, even);
      interleaved(s.odd_taken + s.row * l + at, odd);
      for (std::size_t c = 0; c < 3; ++c) {
        store(even[c], scratch.even.data() + (3 * l + c) * lanes);
        store(odd[c], scratch.odd.data() + (3 * l + c) * lanes);
      }
    }
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
    for (int k = 0; k < padding; ++k) change.add({static_cast<double>(changes[0][c][k]), static_cast<double>(changes[1][c][k])});
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(phase_row);
HWY_EXPORT(scatter_evenly);
HWY_EXPORT(split_taken);
HWY_EXPORT(scatter_directions);

namespace {

// The optical depth of each particle's share of its links, times the pixel's area, one way: added.
void add_weights(const Links& links, float* weights) {
  links.each_list([&](std::size_t at, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) {
      const float before = links.depth[at + k] * (k == 0 ? 1.0F : 0.5F);
      const float after = links.depth[at + k + 1] * (k + 1 == n ? 1.0F : 0.5F);
      weights[links.particle_at(at + k)] += links.area * (before + after);
    }
  });
}

// The iteration's state, and what both kinds of phase function have in common.
struct Iteration {
  const NetworkIteration& a;
  Workers& workers;
  Simd simd;
  const float *particles, *links, *first;
  const std::int32_t* lines;
  float *sources, *residuals;
  std::size_t n, line_count;
  std::size_t row;  // floats of a row of sources: one particle more than there are, of a multiple of as many as lanes
  std::vector<LineLists> lists;
  std::vector<float> sky;  // rgb and an unused float of each direction

  Iteration(const NetworkIteration& algorithm, const BufferView& view, Workers& w, Simd s)
      : a(algorithm),
        workers(w),
        simd(s),
        particles(view.floats(a.particles)),
        links(view.floats(a.links)),
        first(view.floats(a.first)),
        lines(view.integers(a.lines)),
        sources(view.made(a.sources)),
        residuals(view.made(a.residuals)),
        n(static_cast<std::size_t>(a.particle_count)),
        line_count(static_cast<std::size_t>(a.line_count)),
        row(4 * padding * (n / padding + 1)),
        lists(line_count),
        sky(4 * 2 * line_count, 0.0F) {
    if (a.sky) std::copy_n(view.floats(a.sky), sky.size(), sky.begin());
    each_line([&](std::size_t l, std::size_t) { lists[l] = LineLists(links_of(l), n); });
  }

  Links links_of(std::size_t l) const { return {a.shape(), links, lines + l * line_fields, l}; }

  // body(line, worker)
  template <class Body>
  void each_line(Body&& body) {
    workers.each(static_cast<int>(line_count),
                 [&](int l, int worker) { body(static_cast<std::size_t>(l), static_cast<std::size_t>(worker)); });
  }

  // rgb and zero of each particle, then zeros.
  std::vector<float> albedos() const {
    std::vector<float> values(row, 0.0F);
    for (std::size_t v = 0; v < n; ++v) {
      for (std::size_t c = 0; c < 3; ++c) values[4 * v + c] = particles[(particle_albedo + c) * n + v];
    }
    return values;
  }

  // round(changes) makes new sources and tells what changed, a batch an element.
  template <class Round>
  void iterate(std::size_t batches, Round&& round) {
    std::vector<Change> changes(batches);
    std::fill_n(residuals, 1 + static_cast<std::size_t>(a.iterations), 0.0F);
    for (int k = 0; k < a.iterations; ++k) {
      round(changes);
      Change all;
      for (const Change& c : changes) all.add(c);
      residuals[0] = static_cast<float>(k + 1);
      residuals[1 + k] = static_cast<float>(all.change / std::max(all.sum, 1e-30));
      if (a.left_out({residuals + 1, static_cast<std::size_t>(k + 1)}) <= a.tolerance) break;
    }
  }
};

// What particles take in all directions is one number a channel.
void isotropic(Iteration& it) {
  const std::size_t row = it.row;
  std::vector<float> first(row, 0.0F), source, factor = it.albedos(), weight(groups * it.n, 0.0F), taken(groups * row);
  std::copy_n(it.first, 4 * it.n, first.begin());
  source = first;
  std::size_t scratch_floats = 0;
  for (const LineLists& lists : it.lists) scratch_floats = std::max(scratch_floats, lists.scratch_floats());
  std::vector<std::vector<float>> scratch(static_cast<std::size_t>(it.workers.threads()), std::vector<float>(scratch_floats));
  // body(group, line, worker)
  const auto each_group = [&](auto&& body) {
    it.workers.each(groups, [&](int g, int worker) {
      const auto group = static_cast<std::size_t>(g);
      for (std::size_t l = group * it.line_count / groups; l < (group + 1) * it.line_count / groups; ++l) body(group, l, worker);
    });
  };
  each_group([&](std::size_t g, std::size_t l, int) { add_weights(it.links_of(l), weight.data() + g * it.n); });
  for (std::size_t v = 0; v < it.n; ++v) {
    float weights = 0;
    for (std::size_t g = 0; g < groups; ++g) weights += weight[g * it.n + v];
    for (std::size_t c = 0; c < 3; ++c) factor[4 * v + c] *= 0.5F / std::max(weights, 1e-30F);
  }
  EvenScatter scatter{{}, factor.data(), first.data(), source.data()};
  for (std::size_t g = 0; g < groups; ++g) scatter.taken[g] = taken.data() + g * row;
  const std::size_t batches = (row + 4 * batch - 1) / (4 * batch);
  it.iterate(batches, [&](std::vector<Change>& changes) {
    it.workers.each(groups, [&](int g, int worker) {
      const auto group = static_cast<std::size_t>(g);
      float* to = taken.data() + group * row;
      std::fill_n(to, row, 0.0F);
      for (std::size_t l = group * it.line_count / groups; l < (group + 1) * it.line_count / groups; ++l)
        sweep_both_ways(it.lists[l], source.data(), it.sky.data() + 8 * l, scratch[static_cast<std::size_t>(worker)].data(), to,
                        it.simd);
    });
    it.workers.each(static_cast<int>(batches), [&](int b, int) {
      const std::size_t at = 4 * batch * static_cast<std::size_t>(b);
      entry(HWY_DISPATCH_TABLE(scatter_evenly), it.simd)(scatter, at, std::min(at + 4 * batch, row),
                                                         changes[static_cast<std::size_t>(b)]);
    });
  });
  std::copy_n(source.data(), 4 * it.n, it.sources);
}

// A source in each direction. What a particle takes of one is shared out by the phase function over the directions in which it
// sends, each with its own weight, so that what it sends is what it takes, times its albedo.
void anisotropic(Iteration& it) {
  const std::size_t n = it.n, lines = it.line_count, row = it.row, particles = row / 4;
  std::vector<float> even(lines * lines), odd(lines * lines), first(2 * lines * row, 0.0F), weight(lines * n, 0.0F),
      share(lines * particles, 0.0F), even_taken(lines * row), odd_taken(lines * row);
  const std::vector<float> albedo = it.albedos();
  // Rows are columns: the phase function is the same from one direction to another and back.
  it.each_line([&](std::size_t l, std::size_t) {
    entry(HWY_DISPATCH_TABLE(phase_row), it.simd)(it.a.phase, it.lines, static_cast<int>(lines), static_cast<int>(l),
                                                  even.data() + lines * l, odd.data() + lines * l);
    for (std::size_t d = 2 * l; d < 2 * l + 2; ++d) std::copy_n(it.first + 4 * n * d, 4 * n, first.data() + row * d);
    add_weights(it.links_of(l), weight.data() + n * l);
  });
  it.each_line([&](std::size_t l, std::size_t) {
    float* to = share.data() + particles * l;
    for (std::size_t j = 0; j < lines; ++j) {
      const float phase = 2 * even[lines * l + j], *weights = weight.data() + n * j;
      for (std::size_t v = 0; v < n; ++v) to[v] += phase * weights[v];
    }
    for (std::size_t v = 0; v < n; ++v) to[v] = 1 / std::max(to[v], 1e-30F);
  });
  const bool some_odd = std::any_of(odd.begin(), odd.end(), [](float x) { return x != 0; });
  std::vector<float> source = first;
  const auto threads = static_cast<std::size_t>(it.workers.threads());
  std::vector<std::vector<float>> ways(threads, std::vector<float>(2 * row));
  std::vector<ScatterScratch> scratch(threads);
  for (ScatterScratch& s : scratch) s.even.resize(3 * padding * lines), s.odd.resize(3 * padding * lines);
  const Scatter scatter{
      even.data(), some_odd ? odd.data() : nullptr, even_taken.data(), odd_taken.data(), first.data(), source.data(), lines, row};
  const std::size_t batches = particles / padding;
  it.iterate(batches, [&](std::vector<Change>& changes) {
    it.each_line([&](std::size_t l, std::size_t worker) {
      std::vector<float>& taken = ways[worker];
      std::fill(taken.begin(), taken.end(), 0.0F);
      for (const bool backward : {false, true}) {
        const std::size_t d = 2 * l + (backward ? 1 : 0);
        sweep_one_way(it.lists[l], backward, source.data() + row * d, it.sky.data() + 4 * d, taken.data() + (backward ? row : 0),
                      it.simd);
      }
      entry(HWY_DISPATCH_TABLE(split_taken), it.simd)(taken.data(), taken.data() + row, share.data() + particles * l,
                                                      albedo.data(), row, even_taken.data() + row * l,
                                                      odd_taken.data() + row * l);
    });
    it.workers.each(static_cast<int>(batches), [&](int b, int worker) {
      const auto at = static_cast<std::size_t>(b);
      entry(HWY_DISPATCH_TABLE(scatter_directions), it.simd)(scatter, padding * at, scratch[static_cast<std::size_t>(worker)],
                                                             changes[at]);
    });
  });
  it.each_line([&](std::size_t l, std::size_t) {
    for (std::size_t d = 2 * l; d < 2 * l + 2; ++d) std::copy_n(source.data() + row * d, 4 * n, it.sources + 4 * n * d);
  });
}

}  // namespace

void run_volume(const NetworkIteration& a, const BufferView& view, Workers& workers, Simd simd) {
  Iteration it(a, view, workers, simd);
  if (a.phase.kind == PhaseKind::isotropic) {
    isotropic(it);
  } else {
    anisotropic(it);
  }
}

}  // namespace airlight
#endif
