#include "common/fit/fit_gaussians.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/fit/descent.h"
#include "common/fit/placement.h"

namespace airlight {

namespace {

constexpr int rounds = 8;             // of moving what matters least, at most
constexpr double moved = 0.06;        // of all, in each of them
constexpr double round_steps = 0.25;  // of those of a whole descent: the first few gain most
constexpr double gained = 5e-3;       // of the squares: less is no reason for another round
constexpr double early_steps = 0.25;  // of those of a whole descent, while Gaussians are still missing

class Fitting {
 public:
  Fitting(const SparseGrid& grid, const std::string& path, const FitOptions& options, const EachIndex& each, Progress& progress)
      : cells_(grid, path), sum_(cells_, each), options_(options), progress_(progress) {
    const double early = std::max(1.0, early_steps * options.steps);
    all_steps_ = 3 * early + options.steps * (1 + round_steps * rounds);
  }

  Fit run() {
    double value = 0;
    for (const int share : {8, 4, 2, 1}) {
      const int count = std::max(1, options_.count / share) - static_cast<int>(gaussians_.size());
      if (count <= 0) continue;
      sum_.half_squares(gaussians_, nullptr);
      add_at_peaks(cells_, count, sum_.rest(), gaussians_);
      value = descent(share == 1 ? 1 : early_steps);
    }
    for (int round = 0; round < rounds; ++round) {
      const double before = value;
      value = move_the_least(value);
      if (!(before - value > gained * before)) break;
    }
    return result(value);
  }

 private:
  double descent(double share) {
    const int steps = std::max(1, static_cast<int>(share * options_.steps));
    const double begin = done_;
    int step = 0;
    const double value = descend(cells_, sum_, steps, gaussians_, [&](double half_squares) {
      progress_.check();
      progress_.report(fmt::format("fitting {} Gaussians, density {:.2f} % off", gaussians_.size(), 100 * error(half_squares)),
                       std::min(1.0, (begin + ++step) / all_steps_));
    });
    done_ = begin + steps;
    return value;
  }

  // Takes those away whose own squares are least, and puts as many where most is left.
  double move_the_least(double value) {
    const std::vector<FitGaussian> before = gaussians_;
    std::vector<std::size_t> order(gaussians_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto own = [&](std::size_t i) {
      const FitGaussian& g = gaussians_[i];
      return g.extinction * g.extinction * g.radius * g.radius * g.radius;
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return own(a) < own(b); });
    const auto count = static_cast<std::size_t>(moved * static_cast<double>(gaussians_.size()));
    if (count == 0) return value;
    std::vector<bool> gone(gaussians_.size());
    for (std::size_t i = 0; i < count; ++i) gone[order[i]] = true;
    std::vector<FitGaussian> kept;
    for (std::size_t i = 0; i < gaussians_.size(); ++i) {
      if (!gone[i]) kept.push_back(gaussians_[i]);
    }
    gaussians_ = std::move(kept);
    sum_.half_squares(gaussians_, nullptr);
    add_at_peaks(cells_, static_cast<int>(count), sum_.rest(), gaussians_);
    const double after = descent(round_steps);
    if (after < value) return after;
    gaussians_ = before;
    return value;
  }

  double error(double half_squares) const { return std::sqrt(2 * half_squares / cells_.energy()); }

  Fit result(double value) const {
    Fit fit;
    for (const FitGaussian& g : gaussians_) {
      Gaussian out;
      out.center = cells_.axes() * g.center + cells_.origin();
      out.radius = g.radius;
      out.extinction = g.extinction;
      if (g.extinction > 0) fit.gaussians.push_back(out);
    }
    fit.density_error = error(value);
    return fit;
  }

  FitCells cells_;
  GaussianSum sum_;
  FitOptions options_;
  Progress& progress_;
  std::vector<FitGaussian> gaussians_;
  double done_ = 0, all_steps_ = 1;
};

}  // namespace

Fit fit_gaussians(const SparseGrid& grid, const std::string& path, const FitOptions& options, const EachIndex& each,
                  Progress& progress) {
  return Fitting(grid, path, options, each, progress).run();
}

}  // namespace airlight
