// Numbers by a counter: what a test draws depends on its number alone.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "tests/parity/inputs.h"

namespace airlight {

class Draw {
 public:
  explicit Draw(std::uint32_t stream) : stream_(stream) {}
  double unit() { return uniform(stream_, next_++); }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double magnitude(double low, double high) { return low * std::pow(high / low, unit()); }
  int whole(int low, int high) { return low + static_cast<int>(static_cast<double>(high - low + 1) * unit()); }
  bool chance(double share) { return unit() < share; }
  glm::dvec3 vector(double reach) {
    const double x = between(-reach, reach), y = between(-reach, reach);
    return {x, y, between(-reach, reach)};
  }
  glm::dvec3 direction() {
    const double z = between(-1, 1), turn = between(0, 6.283185307179586), s = std::sqrt(1 - z * z);
    return glm::normalize(glm::dvec3(s * std::cos(turn), s * std::sin(turn), z));
  }
  template <class T, std::size_t n>
  T of(const std::array<T, n>& values) {
    return values[static_cast<std::size_t>(static_cast<double>(n) * unit())];
  }

 private:
  std::uint32_t stream_, next_ = 0;
};

}  // namespace airlight
