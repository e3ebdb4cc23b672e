#include "common/scene/keyframes.h"

#include <algorithm>
#include <cmath>

namespace airlight {

namespace {

struct Keys {
  std::span<const int> frames;
  std::span<const double> values;

  double length(std::size_t i) const { return static_cast<double>(frames[i + 1]) - frames[i]; }
  double slope(std::size_t i) const { return (values[i + 1] - values[i]) / length(i); }

  // Steffen 1990, eq. 11. His ends are parabolas; here motion comes to rest, as the value holds beyond.
  double velocity(std::size_t i) const {
    if (i == 0 || i + 1 == frames.size()) return 0;
    const double before = slope(i - 1), after = slope(i);
    if (before * after <= 0) return 0;
    const double parabola = (before * length(i) + after * length(i - 1)) / (length(i - 1) + length(i));
    return std::copysign(2, after) * std::min({std::abs(before), std::abs(after), std::abs(parabola) / 2});
  }
};

}  // namespace

double interpolated(std::span<const int> frames, std::span<const double> values, Interpolation how, int frame) {
  if (frame <= frames.front()) return values.front();
  if (frame >= frames.back()) return values.back();
  const auto next = std::upper_bound(frames.begin(), frames.end(), frame);
  const auto i = static_cast<std::size_t>(next - frames.begin()) - 1;
  const Keys keys{frames, values};
  const double a = values[i], b = values[i + 1], u = (static_cast<double>(frame) - frames[i]) / keys.length(i);
  double v = a + u * (b - a);
  if (how == Interpolation::smooth) {
    // Hermite's cubic as a plus what is added to it, so that what rests stays the same in every bit.
    v = a + u * u * (3 - 2 * u) * (b - a) +
        keys.length(i) * u * (1 - u) * ((1 - u) * keys.velocity(i) - u * keys.velocity(i + 1));
  }
  return std::clamp(v, std::min(a, b), std::max(a, b));  // rounding
}

}  // namespace airlight
