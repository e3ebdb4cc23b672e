#include <algorithm>
#include <cmath>
#include <vector>

#include "cpu/kernels.h"
#include "cpu/network_links.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/network_iteration.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/network.h"

#ifndef AIRLIGHT_CPU_NETWORK_ITERATION
#define AIRLIGHT_CPU_NETWORK_ITERATION
namespace airlight {

namespace {

constexpr int padding = 16;  // the most lanes

// What each direction's share is of what each other one takes: sources in direction i are the sum over d of matrix[d + n i] times
// x[d], row after row of `row` floats.
struct Scatter {
  const float* matrix;
  int directions;
  const float* x;
  std::size_t row;
};

}  // namespace

}  // namespace airlight
#endif

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

// Phase function from the direction of index d (both ways of each line in turn) to direction i.
static void phase_matrix(const Phase& phase, const std::int32_t* lines, int directions, int i, float* row) {
  const auto direction = [&](int n) HWY_ATTR {
    const Real3 d = line_direction_of(lines + static_cast<std::ptrdiff_t>(line_fields) * (n / 2));
    const Real sign = n % 2 == 0 ? 1.0 : -1.0;
    return Real3{d.x * sign, d.y * sign, d.z * sign};
  };
  const Real3 to = direction(i);
  for (int d = 0; d < directions; ++d) {
    HWY_ALIGN float value[16];
    store(phase_value(static_cast<int>(phase.kind), static_cast<float>(phase.g), dot(direction(d), to)), value);
    row[d] = value[0];
  }
}

// Columns begin .. begin + count of all rows of the product, each row `count` floats of `to`: as many as stay in the cache. count
// is a multiple of 4 vectors, the number of directions is even.
static void scatter(const Scatter& s, std::size_t begin, std::size_t count, float* to) {
  for (int i = 0; i < s.directions; i += 2) {
    const float* row = s.matrix + static_cast<std::ptrdiff_t>(s.directions) * i;
    for (std::size_t at = 0; at < count; at += 4 * lanes) {
      Real sum[8] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
      for (int d = 0; d < s.directions; ++d) {
        const float* x = s.x + s.row * static_cast<std::size_t>(d) + begin + at;
        const Real a = row[d], b = row[d + s.directions];
        for (int k = 0; k < 4; ++k) {
          const Real v = load(x + k * lanes);
          sum[k] = fma(a, v, sum[k]);
          sum[4 + k] = fma(b, v, sum[4 + k]);
        }
      }
      float* out = to + static_cast<std::size_t>(i) * count + at;
      for (int k = 0; k < 4; ++k) {
        store(sum[k], out + k * lanes);
        store(sum[4 + k], out + count + k * lanes);
      }
    }
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(phase_matrix);
HWY_EXPORT(scatter);

namespace {

// Light along one way of a bundle: what particles take of it is added to `taken`.
void sweep(const Links& links, bool backward, const float* source, float* taken) {
  links.each_list([&](std::size_t at, std::size_t n) {
    Rgb beam;
    // What the link takes of the beam and of its own source.
    const auto pass = [&](std::size_t k, const Rgb& mean) {
      Rgb got;
      for (std::size_t c = 0; c < 4; ++c) {
        got.v[c] = links.given[k] * beam.v[c] + links.kept[k] * mean.v[c];
        beam.v[c] += links.given[k] * mean.v[c] - links.lost[k] * beam.v[c];
      }
      return got;
    };
    std::size_t here = links.particle_at(backward ? at + n - 1 : at);
    Rgb sent = rgb_at(source, here), waiting = pass(backward ? at + n : at, sent);
    for (std::size_t step = 1; step < n; ++step) {
      const std::size_t k = backward ? at + n - step : at + step, next = links.particle_at(backward ? k - 1 : k);
      const Rgb sent_next = rgb_at(source, next);
      Rgb mean;
      for (std::size_t c = 0; c < 4; ++c) mean.v[c] = 0.5F * (sent.v[c] + sent_next.v[c]);
      Rgb half = pass(k, mean);
      for (std::size_t c = 0; c < 4; ++c) {
        half.v[c] *= 0.5F;
        waiting.v[c] += half.v[c];
      }
      add(taken, here, waiting, links.area);
      waiting = half;
      sent = sent_next;
      here = next;
    }
    const Rgb last = pass(backward ? at : at + n, sent);
    for (std::size_t c = 0; c < 4; ++c) waiting.v[c] += last.v[c];
    add(taken, here, waiting, links.area);
  });
}

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

// Sums over sources, in an order that does not depend on the number of threads.
struct Change {
  double change = 0, sum = 0;
  void add(float before, float now) {
    change += static_cast<double>(std::fabs(now - before));
    sum += static_cast<double>(now);
  }
  void add(const Change& other) {
    change += other.change;
    sum += other.sum;
  }
};

// The iteration's state, and what both kinds of phase function have in common.
struct Iteration {
  const NetworkIteration& a;
  Workers& workers;
  const float *particles, *links, *first;
  const std::int32_t* lines;
  float *sources, *residuals;
  std::size_t n;

  Iteration(const NetworkIteration& algorithm, const BufferView& view, Workers& w)
      : a(algorithm),
        workers(w),
        particles(view.floats(a.particles)),
        links(view.floats(a.links)),
        first(view.floats(a.first)),
        lines(view.integers(a.lines)),
        sources(view.made(a.sources)),
        residuals(view.made(a.residuals)),
        n(static_cast<std::size_t>(a.particle_count)) {}

  Links links_of(std::size_t l) const { return {a.shape(), links, lines + l * line_fields, l}; }
  float albedo(std::size_t v, std::size_t c) const { return particles[(particle_albedo + c) * n + v]; }

  // round() makes new sources, and gives their change.
  template <class Round>
  void iterate(Round&& round) {
    std::fill_n(residuals, 1 + static_cast<std::size_t>(a.iterations), 0.0F);
    for (int k = 0; k < a.iterations; ++k) {
      const Change change = round();
      residuals[0] = static_cast<float>(k + 1);
      residuals[1 + k] = static_cast<float>(change.change / std::max(change.sum, 1e-30));
      if (a.left_out({residuals + 1, static_cast<std::size_t>(k + 1)}) <= a.tolerance) break;
    }
  }
};

constexpr std::size_t groups = 16;  // of lines, whatever the number of threads: sums over them have a fixed order
constexpr std::size_t batch = 64;   // particles

std::size_t batches(std::size_t n) { return (n + batch - 1) / batch; }

// What particles take in all directions is one number a channel.
void isotropic(Iteration& it) {
  const std::size_t n = it.n, lines = static_cast<std::size_t>(it.a.line_count);
  std::vector<std::vector<float>> taken(groups, std::vector<float>(4 * n)), weight(groups, std::vector<float>(n, 0.0F));
  float* source = it.sources;
  std::copy_n(it.first, 4 * n, source);
  const auto each_group = [&](auto&& body) {
    it.workers.each(groups, [&](int g, int) {
      const auto group = static_cast<std::size_t>(g);
      for (std::size_t l = group * lines / groups; l < (group + 1) * lines / groups; ++l) body(group, it.links_of(l));
    });
  };
  each_group([&](std::size_t g, const Links& links) { add_weights(links, weight[g].data()); });
  std::vector<Change> changes(batches(n));
  it.iterate([&] {
    for (std::vector<float>& t : taken) std::fill(t.begin(), t.end(), 0.0F);
    each_group([&](std::size_t g, const Links& links) {
      sweep(links, false, source, taken[g].data());
      sweep(links, true, source, taken[g].data());
    });
    it.workers.each(static_cast<int>(batches(n)), [&](int b, int) {
      const auto at = static_cast<std::size_t>(b);
      Change change;
      for (std::size_t v = at * batch; v < std::min((at + 1) * batch, n); ++v) {
        Rgb sum;
        float weights = 0;
        for (std::size_t g = 0; g < groups; ++g) {
          add(sum.v, 0, rgb_at(taken[g].data(), v), 1.0F);
          weights += weight[g][v];
        }
        const float scale = 0.5F / std::max(weights, 1e-30F);
        for (std::size_t c = 0; c < 3; ++c) {
          const float now = it.first[4 * v + c] + sum.v[c] * scale * it.albedo(v, c);
          change.add(source[4 * v + c], now);
          source[4 * v + c] = now;
        }
      }
      changes[at] = change;
    });
    Change all;
    for (const Change& c : changes) all.add(c);
    return all;
  });
}

// A source in each direction. What a particle takes of one is shared out by the phase function over the directions in which it
// sends, each with its own weight, so that what it sends is what it takes, times its albedo.
void anisotropic(Iteration& it, Simd simd) {
  const std::size_t n = it.n, lines = static_cast<std::size_t>(it.a.line_count), directions = 2 * lines;
  const std::size_t columns = (4 * n + 4 * padding - 1) / (4 * padding) * (4 * padding);
  std::vector<float> matrix(directions * directions), taken(columns * directions), source(columns * directions),
      weight(columns * lines), share(columns * directions);
  it.workers.each(static_cast<int>(directions), [&](int i, int) {
    entry(HWY_DISPATCH_TABLE(phase_matrix), simd)(it.a.phase, it.lines, static_cast<int>(directions), i,
                                                  matrix.data() + directions * static_cast<std::size_t>(i));
    std::copy_n(it.first + 4 * n * static_cast<std::size_t>(i), 4 * n, source.data() + columns * static_cast<std::size_t>(i));
  });
  it.workers.each(static_cast<int>(lines), [&](int l, int) {
    add_weights(it.links_of(static_cast<std::size_t>(l)), weight.data() + columns * static_cast<std::size_t>(l));
  });
  it.workers.each(static_cast<int>(directions), [&](int d, int) {
    float* to = share.data() + columns * static_cast<std::size_t>(d);
    for (std::size_t j = 0; j < directions; ++j) {
      const float phase = matrix[static_cast<std::size_t>(d) + directions * j], *weights = weight.data() + columns * (j / 2);
      for (std::size_t v = 0; v < n; ++v) to[v] += phase * weights[v];
    }
    for (std::size_t v = 0; v < n; ++v) to[v] = 1 / std::max(to[v], 1e-30F);
  });
  constexpr std::size_t block = 8 * 4 * padding;  // of columns
  const std::size_t blocks = (columns + block - 1) / block;
  std::vector<std::vector<float>> products(static_cast<std::size_t>(it.workers.threads()),
                                           std::vector<float>(block * directions));
  std::vector<Change> changes(blocks);
  it.iterate([&] {
    it.workers.each(static_cast<int>(lines), [&](int line, int) {
      const auto l = static_cast<std::size_t>(line);
      const Links links = it.links_of(l);
      for (std::size_t way = 0; way < 2; ++way) {
        const std::size_t d = 2 * l + way;
        float* to = taken.data() + columns * d;
        std::fill_n(to, columns, 0.0F);
        sweep(links, way == 1, source.data() + columns * d, to);
        for (std::size_t v = 0; v < n; ++v) {
          for (std::size_t c = 0; c < 3; ++c) to[4 * v + c] *= share[columns * d + v] * it.albedo(v, c);
        }
      }
    });
    const Scatter product{matrix.data(), static_cast<int>(directions), taken.data(), columns};
    it.workers.each(static_cast<int>(blocks), [&](int b, int worker) {
      const std::size_t begin = block * static_cast<std::size_t>(b), count = std::min(block, columns - begin);
      float* made = products[static_cast<std::size_t>(worker)].data();
      entry(HWY_DISPATCH_TABLE(scatter), simd)(product, begin, count, made);
      Change change;
      for (std::size_t i = 0; i < directions; ++i) {
        float* to = source.data() + columns * i + begin;
        for (std::size_t k = 0; k < count && begin + k < 4 * n; ++k) {
          const float now = it.first[4 * n * i + begin + k] + made[count * i + k];
          change.add(to[k], now);
          to[k] = now;
        }
      }
      changes[static_cast<std::size_t>(b)] = change;
    });
    Change all;
    for (const Change& c : changes) all.add(c);
    return all;
  });
  for (std::size_t d = 0; d < directions; ++d) std::copy_n(source.data() + columns * d, 4 * n, it.sources + 4 * n * d);
}

}  // namespace

void run_volume(const NetworkIteration& a, const BufferView& view, Workers& workers, Simd simd) {
  Iteration it(a, view, workers);
  if (a.phase.kind == PhaseKind::isotropic) {
    isotropic(it);
  } else {
    anisotropic(it, simd);
  }
}

}  // namespace airlight
#endif
