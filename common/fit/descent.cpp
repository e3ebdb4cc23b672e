#include "common/fit/descent.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/matrix.hpp>

namespace airlight {

namespace {

// A narrower Gaussian has another integral than the sum of what it is at the centres of cells, by 6 exp(-(pi r)^2): 1 % at 0.8
// cells, 17 % at 0.6; what is fitted to these would be wrong between them.
constexpr double least_radius = 0.8;  // [cells]
constexpr std::size_t memory = 12;    // pairs of differences
constexpr double longest_step = 0.5;  // of a centre in its radii, of a radius or an extinction in e-folds: the model is local
constexpr double enough = 2e-4;       // of the squares, in ten steps: no more is to be gained

using Numbers = std::vector<double>;

double dot(const Numbers& a, const Numbers& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// Rises from 0 to infinity as exp() does, with the same value, slope and bend at 0, and without the C library's bits.
double growth(double y) { return y > 0 ? 1 + y + 0.5 * y * y : 1 / (1 - y + 0.5 * y * y); }
double growth_slope(double y) { return y > 0 ? 1 + y : (1 - y) * growth(y) * growth(y); }

// Five scaled variables a Gaussian, 0 where it started: its centre along x, y, z, its radius, its extinction.
class Variables {
 public:
  Variables(const FitCells& cells, const std::vector<FitGaussian>& start) : cells_(cells), start_(start) {
    // Sum over the cells of the square of a Gaussian of extinction 1: (pi/2)^(3/2) r^3 a cell's volume.
    std::vector<double> own(start.size());
    double mean = 0;
    for (std::size_t i = 0; i < start.size(); ++i) {
      FitGaussian& g = start_[i];
      g.radius = std::max(g.radius, 1.05 * least());
      const double r = g.radius / cells.cell();
      own[i] = 1.9687012 * r * r * r * g.extinction * g.extinction;
      mean += own[i] / static_cast<double>(start.size());
    }
    scales_.resize(5 * start.size());
    for (std::size_t i = 0; i < start.size(); ++i) {
      // Second derivatives of a Gaussian's own square by a centre in radii, by the radius and by the root of the extinction in
      // e-folds: 1, 15/4, 4 times it. Those of almost nothing would move without end: they are taken for a thousandth of the
      // mean.
      const double s = 1 / std::sqrt(std::max(own[i], 1e-3 * mean) + 1e-300),
                   free = (start_[i].radius - least()) / start_[i].radius;
      for (std::size_t k = 0; k < 3; ++k) scales_[5 * i + k] = s;
      scales_[5 * i + 3] = s / (std::sqrt(3.75) * free);
      scales_[5 * i + 4] = 0.5 * s;
    }
  }

  void gaussians(const Numbers& z, std::vector<FitGaussian>& out) const {
    out.resize(start_.size());
    for (std::size_t i = 0; i < start_.size(); ++i) {
      const FitGaussian& g = start_[i];
      const double* const at = z.data() + 5 * i;
      const double* const s = scales_.data() + 5 * i;
      const double root = 1 + at[4] * s[4];
      out[i].center = g.center + cells_.inverse() * (g.radius * glm::dvec3(at[0] * s[0], at[1] * s[1], at[2] * s[2]));
      out[i].radius = least() + (g.radius - least()) * growth(at[3] * s[3]);
      out[i].extinction = g.extinction * root * root;
    }
  }
  void slopes(const Numbers& z, const std::vector<FitSlopes>& by, Numbers& out) const {
    out.resize(z.size());
    for (std::size_t i = 0; i < start_.size(); ++i) {
      const FitGaussian& g = start_[i];
      const double* const s = scales_.data() + 5 * i;
      for (int k = 0; k < 3; ++k) out[5 * i + static_cast<std::size_t>(k)] = by[i].center[k] * g.radius * s[k];
      out[5 * i + 3] = by[i].radius * (g.radius - least()) * growth_slope(z[5 * i + 3] * s[3]) * s[3];
      out[5 * i + 4] = by[i].extinction * 2 * g.extinction * (1 + z[5 * i + 4] * s[4]) * s[4];
    }
  }
  // Gaussians that a step would move too far go as far as they may, each by itself: were the whole step shortened, one that
  // hardly matters would hold all others.
  void shorten(Numbers& step) const {
    for (std::size_t i = 0; i < step.size(); i += 5) {
      double most = 0;
      for (std::size_t k = i; k < i + 5; ++k) most = std::max(most, std::abs(step[k] * scales_[k]));
      for (std::size_t k = i; k < i + 5 && most > longest_step; ++k) step[k] *= longest_step / most;
    }
  }

 private:
  double least() const { return least_radius * cells_.cell(); }

  const FitCells& cells_;
  std::vector<FitGaussian> start_;
  Numbers scales_;
};

// Differences of places and of slopes, the last few of them.
class Memory {
 public:
  void add(const Numbers& place, const Numbers& before, const Numbers& slope, const Numbers& slope_before) {
    Pair p{place, slope, 0};
    for (std::size_t i = 0; i < place.size(); ++i) p.moved[i] -= before[i], p.bent[i] -= slope_before[i];
    p.product = dot(p.moved, p.bent);
    if (!(p.product > 1e-12 * dot(p.bent, p.bent))) return;  // no curvature: nothing to learn
    pairs_.push_back(std::move(p));
    if (pairs_.size() > memory) pairs_.pop_front();
  }
  bool empty() const { return pairs_.empty(); }
  void clear() { pairs_.clear(); }

  // The way to go.
  Numbers direction(const Numbers& slope) const {
    Numbers d(slope);
    std::vector<double> shares;
    for (auto p = pairs_.rbegin(); p != pairs_.rend(); ++p) {
      shares.push_back(dot(p->moved, d) / p->product);
      add_to(d, -shares.back(), p->bent);
    }
    if (!pairs_.empty()) {
      const Pair& last = pairs_.back();
      const double scale = last.product / dot(last.bent, last.bent);
      for (double& v : d) v *= scale;
    }
    for (const Pair& p : pairs_) {
      add_to(d, shares.back() - dot(p.bent, d) / p.product, p.moved);
      shares.pop_back();
    }
    for (double& v : d) v = -v;
    return d;
  }

 private:
  struct Pair {
    Numbers moved, bent;
    double product;
  };
  static void add_to(Numbers& to, double factor, const Numbers& what) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * what[i];
  }
  std::deque<Pair> pairs_;
};

}  // namespace

double descend(const FitCells& cells, GaussianSum& sum, int steps, std::vector<FitGaussian>& gaussians,
               const std::function<void(double)>& after) {
  const Variables variables(cells, gaussians);
  Numbers z(5 * gaussians.size(), 0.0), slope, next(z.size()), next_slope;
  std::vector<FitSlopes> by;
  std::vector<FitGaussian> tried;
  variables.gaussians(z, gaussians);
  double value = sum.half_squares(gaussians, &by);
  variables.slopes(z, by, slope);

  Memory known;
  std::vector<double> values{value};
  for (int step = 0; step < steps; ++step) {
    Numbers way = known.direction(slope);
    variables.shorten(way);
    const double descent = dot(way, slope);
    double length = 1, tried_value = 0;
    bool lower = false;
    for (int k = 0; k < 12 && !lower && descent < 0; ++k, length *= 0.5) {
      for (std::size_t i = 0; i < z.size(); ++i) next[i] = z[i] + length * way[i];
      variables.gaussians(next, tried);
      tried_value = sum.half_squares(tried, &by);
      lower = tried_value <= value + 1e-4 * length * descent;  // Armijo 1966
      if (lower) break;
    }
    if (!lower) {
      if (known.empty()) break;
      known.clear();
      continue;
    }
    variables.slopes(next, by, next_slope);
    known.add(next, z, next_slope, slope);
    z.swap(next), slope.swap(next_slope), gaussians.swap(tried);
    value = tried_value;
    values.push_back(value);
    after(value);
    if (values.size() > 10 && values[values.size() - 11] - value < enough * value) break;
  }
  return value;
}

}  // namespace airlight
