// A Gaussian on the cells of a block, four at a time: what fitting spends its time on. The same bits on every machine: + - *
// only.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "common/fit/fit_cells.h"

namespace airlight {

using Lanes = float __attribute__((vector_size(16)));
using LaneBits = std::int32_t __attribute__((vector_size(16)));

inline Lanes lanes(float v) { return Lanes{v, v, v, v}; }
inline Lanes load(const float* from) {
  Lanes v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void store(float* to, Lanes v) { std::memcpy(to, &v, sizeof v); }

// exp(-q) for 0 <= q <= 80; 3e-6 of it off at most: 2^(n + f) with a polynomial of degree 5 for |f| <= 1/2.
inline Lanes exp_minus(Lanes q) {
  const Lanes t = q * -1.44269504F;
  const Lanes magic = lanes(12582912.0F);  // 1.5 * 2^23: a sum with it has no bits for fractions
  const Lanes sum = t + magic, f = t - (sum - magic);
  const LaneBits n = std::bit_cast<LaneBits>(sum) - std::bit_cast<LaneBits>(magic);
  const LaneBits bits = (n + 127) << 23;
  const Lanes p =
      1.0F + f * (0.693147180F + f * (0.240226507F + f * (0.0555041087F + f * (0.00961812911F + f * 0.00133335581F))));
  return p * std::bit_cast<Lanes>(bits);
}

// exp(-q), q = |A (x - center)|^2 / radius^2, on one block.
class BlockGaussian {
 public:
  // Beyond it a Gaussian counts as 0: exp(-12) = 6e-6 of its peak.
  static constexpr double farthest = 12;
  static constexpr double reach = 3.4641016151377544;  // [radius] sqrt(farthest)

  BlockGaussian(const FitCells& cells, std::size_t block, const FitGaussian& g) {
    const glm::dmat3& a = cells.axes();
    const double scale = 1 / (g.radius * g.radius);
    const auto product = [&](int i, int k) {
      return static_cast<float>(scale * (a[i][0] * a[k][0] + a[i][1] * a[k][1] + a[i][2] * a[k][2]));
    };
    xx_ = product(0, 0), yy_ = product(1, 1), zz_ = product(2, 2);
    xy_ = 2 * product(0, 1), xz_ = 2 * product(0, 2), yz_ = 2 * product(1, 2);
    const glm::dvec3 from = glm::dvec3(cells.first(block)) - g.center;
    x_ = static_cast<float>(from.x), y_ = static_cast<float>(from.y), z_ = static_cast<float>(from.z);
  }

  // visit(row, y, z, q of the cells 0..3, q of the cells 4..7) for each row that it reaches; y and z from its centre [cells].
  template <class Visit>
  void each_row(Visit&& visit) const {
    const Lanes low = dx(0), high = dx(4);
    for (int k = 0; k < 8; ++k) {
      const float z = z_ + static_cast<float>(k);
      for (int j = 0; j < 8; ++j) {
        const float y = y_ + static_cast<float>(j), b = xy_ * y + xz_ * z, c = yy_ * y * y + yz_ * y * z + zz_ * z * z;
        const float foot = -0.5F * b / xx_, nearest = foot < x_ ? x_ : foot > x_ + 7 ? x_ + 7 : foot;
        if ((xx_ * nearest + b) * nearest + c > static_cast<float>(farthest)) continue;
        visit(j + 8 * k, y, z, bounded((xx_ * low + b) * low + c), bounded((xx_ * high + b) * high + c));
      }
    }
  }

  // x of the cells i..i+3 from its centre [cells].
  Lanes dx(int i) const {
    const float x = x_ + static_cast<float>(i);
    return Lanes{x, x + 1, x + 2, x + 3};
  }

 private:
  // What exp_minus takes, also where rounding made it negative. exp(-80) adds nothing.
  static Lanes bounded(Lanes q) {
    q = q < 0.0F ? lanes(0) : q;
    return q > 80.0F ? lanes(80) : q;
  }

  float xx_, yy_, zz_, xy_, xz_, yz_;
  float x_, y_, z_;
};

}  // namespace airlight
