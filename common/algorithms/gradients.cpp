#include "common/algorithms/gradients.h"

#include <algorithm>
#include <cmath>

namespace airlight {

namespace {

// Eigenvalues of 1 - M that single precision cannot tell from 0: light that does not come out.
constexpr double least_eigenvalue = 1e-6;

}  // namespace

Gradients::Gradients(std::span<const float> first, std::span<const float> albedo, std::span<const float> share)
    : particles_(share.size()), first_(first.begin(), first.end()), way_(first_), share_(share.begin(), share.end()) {
  const std::size_t values = 3 * particles_;
  factor_.resize(values), source_.resize(values), residual_.resize(values), change_of_way_.resize(values);
  for (std::size_t c = 0; c < 3; ++c) {
    Channel& channel = channels_[c];
    for (std::size_t v = 0; v < particles_; ++v) {
      const auto a = static_cast<double>(albedo[c * particles_ + v]);
      factor_[c * particles_ + v] = share_[v] * a;
      source_[c * particles_ + v] = static_cast<double>(first_[4 * v + c]);
      channel.most_albedo = std::max(channel.most_albedo, a);
      channel.albedos += a / share_[v];
    }
  }
}

void Gradients::take(std::span<const float> taken) {
  if (begun_) {
    step(taken);
  } else {
    begin(taken);
  }
  begun_ = true;
  measure();
}

void Gradients::begin(std::span<const float> taken) {
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t v = 0; v < particles_; ++v) {
      const std::size_t at = c * particles_ + v;
      residual_[at] = factor_[at] * static_cast<double>(taken[4 * v + c]);
      way_[4 * v + c] = static_cast<float>(residual_[at]);
      if (factor_[at] > 0) channels_[c].residual += residual_[at] * residual_[at] / factor_[at];
    }
  }
}

void Gradients::step(std::span<const float> taken) {
  for (std::size_t c = 0; c < 3; ++c) {
    Channel& channel = channels_[c];
    if (channel.residual <= 0) continue;
    double size = 0, along = 0;
    for (std::size_t v = 0; v < particles_; ++v) {
      const std::size_t at = c * particles_ + v;
      const auto way = static_cast<double>(way_[4 * v + c]);
      change_of_way_[at] = way - factor_[at] * static_cast<double>(taken[4 * v + c]);
      if (factor_[at] <= 0) continue;
      size += way * way / factor_[at];
      along += way * change_of_way_[at] / factor_[at];
    }
    const double length = channel.residual / std::max(along, least_eigenvalue * size), before = channel.residual;
    channel.residual = 0;
    if (size <= 0) continue;  // less than floats can tell
    for (std::size_t v = 0; v < particles_; ++v) {
      const std::size_t at = c * particles_ + v;
      source_[at] += length * static_cast<double>(way_[4 * v + c]);
      residual_[at] -= length * change_of_way_[at];
      if (factor_[at] > 0) channel.residual += residual_[at] * residual_[at] / factor_[at];
    }
    const double turn = channel.residual / before;
    for (std::size_t v = 0; v < particles_; ++v) {
      float& way = way_[4 * v + c];
      way = static_cast<float>(residual_[c * particles_ + v] + turn * static_cast<double>(way));
    }
    channel.steps.push_back(length), channel.turns.push_back(turn);
  }
}

void Gradients::finish(std::span<float> sources) const {
  for (std::size_t v = 0; v < particles_; ++v) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t at = c * particles_ + v;
      sources[4 * v + c] = std::max(static_cast<float>(source_[at] + residual_[at]), first_[4 * v + c]);
    }
    sources[4 * v + 3] = 0;
  }
}

// What is left out of the light of one channel, sum of albedo times error in the inner product: by Cauchy and Schwarz no more
// than the norm of the albedos, times that of M (1 - M)^-1/2, times the error's in the energy norm.
void Gradients::measure() {
  double changed = 0, sources = 0, light = 0, left = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t v = 0; v < particles_; ++v) {
      const std::size_t at = c * particles_ + v;
      const double source = source_[at] + residual_[at];
      changed += std::fabs(residual_[at]);
      sources += source;
      light += source / share_[v];
    }
    left += channels_[c].left_out();
  }
  change_ = changed / std::max(sources, 1e-30);
  left_out_ = left > 0 ? left / std::max(light, 1e-30 * left) : 0;
}

// The least eigenvalue of the tridiagonal matrix that Lanczos makes of 1 - M, a little below: the largest number by which all
// pivots stay positive.
double Gradients::Channel::smallest_eigenvalue() const {
  const auto below = [&](double x) {
    double pivot = 1;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const double turned = k == 0 ? 0 : turns[k - 1] / steps[k - 1];
      const double beside = k == 0 ? 0 : turned / steps[k - 1];
      pivot = 1 / steps[k] + turned - x - beside / pivot;
      if (!(pivot > 0)) return false;
    }
    return true;
  };
  double low = 0, high = 1;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (below(middle) ? low : high) = middle;
  }
  return low;
}

// The error in the energy norm is at most what Gauss' and Radau's quadrature with a node at a bound of the least eigenvalue makes
// of the rounds (Meurant and Tichy 2013).
double Gradients::Channel::left_out() const {
  if (residual <= 0) return 0;
  constexpr double still_falls = 0.9;  // rounds know the least eigenvalue from above
  double least = 1 - most_albedo;      // no particle sends more of what it takes
  if (!steps.empty()) least = std::max(least, still_falls * smallest_eigenvalue());
  least = std::clamp(least, least_eigenvalue, 1.0);
  double beyond = 1 / least;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double more = std::max(beyond - steps[k], 0.0), below = least * more + turns[k];
    beyond = below > 0 ? more / below : 0;
  }
  return std::sqrt(albedos * beyond * residual / least) * (1 - least);
}

}  // namespace airlight
