#include <algorithm>
#include <cmath>
#include <vector>

#include "common/algorithms/gradients.h"
#include "cpu/kernels.h"
#include "cpu/network_links.h"
#include "cpu/network_scatter.h"
#include "cpu/network_sweep.h"

namespace airlight {

namespace {

constexpr std::size_t batch = 64;  // particles

// The optical depth of each particle's share of its links, times the list's area, one way: added.
void add_weights(const Links& links, const float* masses, float* weights) {
  links.each_list([&](std::size_t at, std::size_t n) {
    const float area = links.area(at, n, masses);
    for (std::size_t k = 0; k < n; ++k) {
      const float before = links.depth[at + k] * (k == 0 ? 1.0F : 0.5F);
      const float after = links.depth[at + k + 1] * (k + 1 == n ? 1.0F : 0.5F);
      weights[links.particle_at(at + k)] += area * (before + after);
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
  float* sources;
  std::span<float> residuals;
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
        residuals(view.made(a.residuals), a.residual_floats()),
        n(static_cast<std::size_t>(a.particle_count)),
        line_count(static_cast<std::size_t>(a.line_count)),
        row(4 * particle_padding * (n / particle_padding + 1)),
        lists(line_count),
        sky(4 * 2 * line_count, 0.0F) {
    if (a.sky) std::copy_n(view.floats(a.sky), sky.size(), sky.begin());
    std::fill(residuals.begin(), residuals.end(), 0.0F);
    each_line([&](std::size_t l, std::size_t) { lists[l] = LineLists(links_of(l), masses(), n); });
  }

  Links links_of(std::size_t l) const { return {a.shape(), links, l}; }
  const float* masses() const { return particles + particle_mass * n; }

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
    std::vector<SourceChange> changes(batches);
    for (int k = 0; k < a.iterations; ++k) {
      round(changes);
      SourceChange all;
      for (const SourceChange& c : changes) all.add(c);
      if (a.add_round(residuals, k, all.change / std::max(all.sum, 1e-30))) break;
    }
  }
};

// Isotropic: what particles take in all directions is one number a channel. Lines are swept in groups, whose sums are of a fixed
// order.
class EvenSweeps {
 public:
  explicit EvenSweeps(Iteration& it)
      : it_(it), taken_(line_groups * it.row), scratch_(static_cast<std::size_t>(it.workers.threads())) {
    std::size_t scratch_floats = 0;
    for (const LineLists& lists : it.lists) scratch_floats = std::max(scratch_floats, lists.scratch_floats());
    for (std::vector<float>& s : scratch_) s.resize(scratch_floats);
  }

  // 1 over half of what a particle could take both ways.
  std::vector<float> shares() const {
    std::vector<float> weight(line_groups * it_.n, 0.0F), shares(it_.n);
    each_group([&](std::size_t group, std::size_t begin, std::size_t end, int) {
      for (std::size_t l = begin; l < end; ++l) add_weights(it_.links_of(l), it_.masses(), weight.data() + group * it_.n);
    });
    for (std::size_t v = 0; v < it_.n; ++v) {
      float weights = 0;
      for (std::size_t g = 0; g < line_groups; ++g) weights += weight[g * it_.n + v];
      shares[v] = 0.5F / std::max(weights, 1e-30F);
    }
    return shares;
  }

  // What each group's lines bring of sources, a row of floats each.
  const float* sweep(const float* source, bool under_sky) {
    static constexpr float none[8] = {};
    each_group([&](std::size_t group, std::size_t begin, std::size_t end, int worker) {
      float *to = taken_.data() + group * it_.row, *own = scratch_[static_cast<std::size_t>(worker)].data();
      std::fill_n(to, it_.row, 0.0F);
      for (std::size_t l = begin; l < end; ++l)
        sweep_both_ways(it_.lists[l], source, under_sky ? it_.sky.data() + 8 * l : none, own, to, it_.simd);
    });
    return taken_.data();
  }

 private:
  // body(group, its first line, the one after its last, worker)
  template <class Body>
  void each_group(Body&& body) const {
    it_.workers.each(line_groups, [&](int g, int worker) {
      const auto group = static_cast<std::size_t>(g);
      body(group, group * it_.line_count / line_groups, (group + 1) * it_.line_count / line_groups, worker);
    });
  }

  Iteration& it_;
  std::vector<float> taken_;
  std::vector<std::vector<float>> scratch_;
};

// Each round an order of scattering.
void isotropic(Iteration& it) {
  const std::size_t row = it.row;
  EvenSweeps sweeps(it);
  std::vector<float> first(row, 0.0F), factor = it.albedos();
  std::copy_n(it.first, 4 * it.n, first.begin());
  std::vector<float> source = first;
  const std::vector<float> share = sweeps.shares();
  for (std::size_t v = 0; v < it.n; ++v) {
    for (std::size_t c = 0; c < 3; ++c) factor[4 * v + c] *= share[v];
  }
  EvenScatter scatter{{}, factor.data(), first.data(), source.data()};
  const std::size_t batches = (row + 4 * batch - 1) / (4 * batch);
  it.iterate(batches, [&](std::vector<SourceChange>& changes) {
    const float* taken = sweeps.sweep(source.data(), true);
    for (std::size_t g = 0; g < line_groups; ++g) scatter.taken[g] = taken + g * row;
    it.workers.each(static_cast<int>(batches), [&](int b, int) {
      const std::size_t at = 4 * batch * static_cast<std::size_t>(b);
      changes[static_cast<std::size_t>(b)] = scatter_evenly(scatter, at, std::min(at + 4 * batch, row), it.simd);
    });
  });
  std::copy_n(source.data(), 4 * it.n, it.sources);
}

// Each round one of conjugate gradients; but for the sweeps they are little work.
void isotropic_gradients(Iteration& it) {
  EvenSweeps sweeps(it);
  std::vector<float> first(it.row, 0.0F), all(it.row);
  std::copy_n(it.first, 4 * it.n, first.begin());
  Gradients gradients(first, {it.particles + particle_albedo * it.n, 3 * it.n}, sweeps.shares());
  for (int k = 0; k < it.a.iterations; ++k) {
    const float* taken = sweeps.sweep(gradients.way().data(), k == 0);
    std::copy_n(taken, it.row, all.begin());
    for (std::size_t g = 1; g < line_groups; ++g) {
      const float* of_group = taken + g * it.row;
      for (std::size_t e = 0; e < it.row; ++e) all[e] += of_group[e];
    }
    gradients.take(all);
    if (it.a.add_round(it.residuals, k, gradients.change(), gradients.left_out())) break;
  }
  gradients.finish({it.sources, 4 * it.n});
}

// A source in each direction: the phase function's mean of the radiance that a particle takes of each, what it takes beside what
// it could. It sends in each by its own weight, so that this is not yet what it takes, times its albedo: what is left, or is too
// much, goes evenly in all directions. (Shares of what is taken, by the weights that it goes to, would keep energy as well; but
// then few directions about a forward peak count by how long links happen to be, and half as much again is off.)
void anisotropic(Iteration& it) {
  const std::size_t n = it.n, lines = it.line_count, row = it.row, particles = row / 4;
  std::vector<float> even(lines * lines), odd(lines * lines), first(2 * lines * row, 0.0F), weight(lines * n, 0.0F),
      share(lines * particles, 0.0F), rest(lines * particles, 0.0F), all_weights(n, 0.0F), even_taken(lines * row),
      odd_taken(lines * row);
  const std::vector<float> albedo = it.albedos();
  // Rows are columns: the phase function is the same from one direction to another and back.
  it.each_line([&](std::size_t l, std::size_t) {
    phase_row(it.a.phase, it.lines, static_cast<int>(lines), static_cast<int>(l), even.data() + lines * l, odd.data() + lines * l,
              it.simd);
    for (std::size_t d = 2 * l; d < 2 * l + 2; ++d) std::copy_n(it.first + 4 * n * d, 4 * n, first.data() + row * d);
    add_weights(it.links_of(l), it.masses(), weight.data() + n * l);
  });
  for (std::size_t l = 0; l < lines; ++l) {
    for (std::size_t v = 0; v < n; ++v) all_weights[v] += 2 * weight[n * l + v];
  }
  for (float& w : all_weights) w = 1 / std::max(w, 1e-30F);
  it.each_line([&](std::size_t l, std::size_t) {
    float* to = share.data() + particles * l;
    for (std::size_t j = 0; j < lines; ++j) {
      const float phase = 2 * even[lines * l + j], *weights = weight.data() + n * j;
      for (std::size_t v = 0; v < n; ++v) to[v] += phase * weights[v];
    }
    float of_phase = 0;
    for (std::size_t j = 0; j < lines; ++j) of_phase += 2 * even[lines * l + j];
    for (std::size_t v = 0; v < n; ++v) {
      const float could = of_phase * weight[n * l + v];
      rest[particles * l + v] = (could - to[v]) * all_weights[v];
      to[v] = 1 / std::max(could, 1e-30F);
    }
  });
  const bool some_odd = std::any_of(odd.begin(), odd.end(), [](float x) { return x != 0; });
  std::vector<float> source = first;
  const auto threads = static_cast<std::size_t>(it.workers.threads());
  std::vector<std::vector<float>> ways(threads, std::vector<float>(2 * row));
  std::vector<ScatterScratch> scratch(threads);
  for (ScatterScratch& s : scratch) s.even.resize(3 * particle_padding * lines), s.odd.resize(3 * particle_padding * lines);
  const DirectionScatter scatter{even.data(), odd.data(),          even_taken.data(), odd_taken.data(),
                                 rest.data(), first.data(),        source.data(),     lines,
                                 row,         some_odd ? lines : 0};
  const std::size_t batches = particles / particle_padding;
  it.iterate(batches, [&](std::vector<SourceChange>& changes) {
    it.each_line([&](std::size_t l, std::size_t worker) {
      std::vector<float>& taken = ways[worker];
      std::fill(taken.begin(), taken.end(), 0.0F);
      for (const bool backward : {false, true}) {
        const std::size_t d = 2 * l + (backward ? 1 : 0);
        sweep_one_way(it.lists[l], backward, source.data() + row * d, it.sky.data() + 4 * d, taken.data() + (backward ? row : 0),
                      it.simd);
      }
      split_taken(taken.data(), taken.data() + row, share.data() + particles * l, albedo.data(), row, even_taken.data() + row * l,
                  odd_taken.data() + row * l, it.simd);
    });
    it.workers.each(static_cast<int>(batches), [&](int b, int worker) {
      const auto at = static_cast<std::size_t>(b);
      changes[at] = scatter_directions(scatter, particle_padding * at, scratch[static_cast<std::size_t>(worker)], it.simd);
    });
  });
  it.each_line([&](std::size_t l, std::size_t) {
    for (std::size_t d = 2 * l; d < 2 * l + 2; ++d) std::copy_n(source.data() + row * d, 4 * n, it.sources + 4 * n * d);
  });
}

}  // namespace

void run_volume(const NetworkIteration& a, const BufferView& view, Workers& workers, Simd simd) {
  Iteration it(a, view, workers, simd);
  if (a.gradients) {
    isotropic_gradients(it);
  } else if (a.phase.kind == PhaseKind::isotropic) {
    isotropic(it);
  } else {
    anisotropic(it);
  }
}

}  // namespace airlight
