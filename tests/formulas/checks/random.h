// Random numbers and vectors for the checks, the same on every machine.
#pragma once

#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "tests/formulas/checks/check.h"
#include "tests/parity/inputs.h"

namespace airlight {

// Numbers of one stream, in turn.
class Random {
 public:
  explicit Random(std::uint32_t stream) : stream_(stream) {}
  double number(double from = 0, double to = 1) { return from + (to - from) * uniform(stream_, next_++); }
  // Uniform in the logarithm.
  double magnitude(double from, double to) { return from * std::pow(to / from, number()); }
  glm::dvec3 direction() {
    const double z = number(-1, 1), a = number(0, 6.283185307179586), r = std::sqrt(1 - z * z);
    return {r * std::cos(a), r * std::sin(a), z};
  }

 private:
  std::uint32_t stream_, next_ = 0;
};

inline glm::dvec3 as_float(const glm::dvec3& v) { return {as_float(v.x), as_float(v.y), as_float(v.z)}; }

// The vector in columns k, k + 1, k + 2.
inline glm::dvec3 vector_at(const Columns& columns, std::size_t k, std::size_t i) {
  return {columns[k][i], columns[k + 1][i], columns[k + 2][i]};
}

}  // namespace airlight
