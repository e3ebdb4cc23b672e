#include "common/scene/tonemap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace airlight {

namespace {

// The sRGB curve backwards, in extended precision so that the bits do not depend on the C library.
double linear(double s) {
  if (s <= 0.04045) return s / 12.92;
  const long double base = (static_cast<long double>(s) + 0.055L) / 1.055L;
  return static_cast<double>(std::pow(base, 2.4L));
}

// thresholds[k] is the least linear value that becomes k + 1: where 255 times the curve reaches k + 1/2.
std::array<double, 255> make_thresholds() {
  std::array<double, 255> t{};
  for (std::size_t k = 0; k < t.size(); ++k) t[k] = linear((static_cast<double>(k) + 0.5) / 255);
  return t;
}

}  // namespace

std::vector<std::uint8_t> tone_mapped(const HostImage& image, double exposure, bool reinhard) {
  // Rounding against 255 thresholds needs no power a pixel. They are rounded to a double: 1e-16 of a level.
  static const std::array<double, 255> thresholds = make_thresholds();
  const auto gain = static_cast<double>(std::exp2(static_cast<long double>(exposure)));
  std::vector<std::uint8_t> out(image.values.size());
  std::transform(image.values.begin(), image.values.end(), out.begin(), [&](float value) {
    double v = static_cast<double>(value) * gain;
    if (!(v > 0)) return std::uint8_t{0};
    if (reinhard) v = std::isinf(v) ? 1 : v / (1 + v);
    return static_cast<std::uint8_t>(std::upper_bound(thresholds.begin(), thresholds.end(), v) - thresholds.begin());
  });
  return out;
}

}  // namespace airlight
