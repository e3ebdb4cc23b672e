#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "common/algorithms/field.h"
#include "common/algorithms/network.h"
#include "common/algorithms/view.h"
#include "common/image.h"

namespace airlight {

// Multiple scattering among the particles (Szirmay-Kalos et al. 2005, 3.3). A round sweeps every list from end to end, both ways,
// so that light goes through all of the medium and scatters once more: it is a whole order of scattering. Along a link the source
// is the mean of its ends; a particle takes half of what its two links take (link_shares() in common/formulas/network.h) and
// gives all of that, times its albedo, so that at albedo 1 as much light leaves the medium as sources put into it. With a phase
// function it sends the mean of the radiance that it takes, weighed by that, and evenly what this leaves. As printed, a
// particle's opacity is that of the link before it in whatever direction, and energy is lost.
//
// `gradients`: conjugate gradients (gradients.h) in place of a sum of orders, for an isotropic phase function alone: a round
// takes the same sweeps, and the last one ends in an order of scattering, so that one round is the first order either way.
struct NetworkIteration {
  Buffer particles, lines, links, first;
  Buffer sky;  // of an environment, optional: what light begins with beyond the lists' ends [W/m^2/sr], laid out as `first` of
               // one particle
  Phase phase;
  int particle_count = 1, line_count = 1;
  int window = 1;
  float tolerance = 1e-3F;  // it stops where no more than that is left out
  int iterations = 100;     // at most, > 0
  bool gradients = false;

  Buffer sources;    // laid out as `first`: all that a particle sends
  Buffer residuals;  // how many rounds there were, what is left out, then what an order of scattering changed in each round

  std::size_t residual_floats() const { return 2 + static_cast<std::size_t>(iterations); }

  // About how much more all sources together would be for all the rounds that were not made, beside what they are; `history` is
  // of the changes in each round, summed over all sources, beside their sum. Of a round each is a share of the one before that
  // becomes the same for all, from below mostly, and what is left is a geometric series. (The largest change beside the largest
  // source is not what an image sees: the largest source is next to a lamp, and the farther from it the longer it takes.)
  static float left_out(std::span<const float> history) {
    constexpr double rounding = 1.2e-7;  // sums of floats do not grow by less
    if (history.empty()) return 1;
    const auto change = static_cast<double>(history.back());
    if (change <= rounding) return history.back();
    const double before = (history.size() > 1 ? static_cast<double>(history[history.size() - 2]) : 1) * (1 - change);
    const double ratio = change / before;
    return static_cast<float>(change * ratio / std::max(1 - ratio, 1e-6));
  }

  // A round into the buffer of residuals, from 0 on. `left`: what is left out where that is not left_out() of the changes. True
  // where it is little enough.
  bool add_round(std::span<float> buffer, int round, double change, std::optional<double> left = std::nullopt) const {
    const auto made = static_cast<std::size_t>(round) + 1;
    buffer[0] = static_cast<float>(made);
    buffer[1 + made] = static_cast<float>(change);
    buffer[1] = left ? static_cast<float>(*left) : left_out(buffer.subspan(2, made));
    return buffer[1] <= tolerance;
  }

  // What the buffer of residuals says, to the statistics of a step.
  template <class Stats>
  void tell(std::span<const float> buffer, Stats& stats) const {
    const auto history = buffer.subspan(2, static_cast<std::size_t>(buffer[0]));
    stats.residuals.assign(history.begin(), history.end());
    stats.left_out = buffer[1];
    stats.converged = stats.left_out <= tolerance;
  }

  NetworkShape shape() const {
    const auto side = static_cast<std::size_t>(window);
    return {static_cast<std::size_t>(particle_count), static_cast<std::size_t>(line_count), side * side};
  }

  static constexpr std::string_view name = "network_iteration";
  static constexpr Domain domain = Domain::volume;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("particles"), s.particles);
    v(in("lines"), s.lines);
    v(in("links"), s.links);
    v(in("first", "W/m^2/sr"), s.first);
    v(in("sky", "W/m^2/sr"), s.sky);
    v(knob("phase"), s.phase);
    v(knob("particle_count"), s.particle_count);
    v(knob("line_count"), s.line_count);
    v(knob("window"), s.window);
    v(knob("tolerance"), s.tolerance);
    v(knob("iterations"), s.iterations);
    v(knob("gradients"), s.gradients);
    v(out("sources", "W/m^2/sr"), s.sources);
    v(out("residuals"), s.residuals);
  }
};

}  // namespace airlight
