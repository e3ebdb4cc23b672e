// The double-precision build of the formulas, namespace airlight::f64 (see README.md in this folder).
#pragma once

#include <cmath>
#include <cstdint>

#include "common/half.h"

namespace airlight::f64 {

using real = double;
using mask = bool;
using table = const float*;
#define FORMULA inline
#define OUT(type) type&
#define IN_LIST(name, count) const real* name
#define OUT_LIST(name, count) real* name
#define IN_OUT_LIST(name, count) real* name
#define EXACT

inline bool any_lane(mask m) { return m; }
inline real select(mask m, real a, real b) { return m ? a : b; }
inline real sqrt(real x) { return std::sqrt(x); }
inline real abs(real x) { return std::fabs(x); }
inline real min(real a, real b) { return a < b ? a : b; }
inline real max(real a, real b) { return a > b ? a : b; }
inline real floor(real x) { return std::floor(x); }
inline real fma(real a, real b, real c) { return std::fma(a, b, c); }
inline real round_even(real x) { return std::nearbyint(x); }
inline real exp2_int(real n) { return std::ldexp(1.0, static_cast<int>(n)); }
inline real exponent_of(real x) { return std::ilogb(x); }
inline real mantissa_of(real x) { return std::ldexp(x, -std::ilogb(x)); }
inline real fetch(table t, real i) { return static_cast<real>(t[static_cast<long>(i)]); }
inline real element(table t, int i) { return static_cast<real>(t[i]); }
inline int integer_element(table t, int i) { return static_cast<int>(t[i]); }
// sum_ik a_i b_k t[at + i stride + k], i and k in 0..3.
inline real weighted_patch(table t, real at, int stride, real a0, real a1, real a2, real a3, real b0, real b1, real b2, real b3) {
  const float* p = t + static_cast<long>(at);
  const auto row = [&](const float* q) { return fma(b0, real(q[0]), fma(b1, real(q[1]), fma(b2, real(q[2]), b3 * real(q[3])))); };
  return fma(a0, row(p), fma(a1, row(p + stride), fma(a2, row(p + 2 * stride), a3 * row(p + 3 * stride))));
}
// The value at (x + u, y + v, z + w) between eight elements of a box in a table, x fastest: element (x, y, z) is number
// x + nx (y + ny z). Lower corners and sizes are integral; linear an axis at a time, x first.
inline real value_of(float x) { return static_cast<real>(x); }
inline real value_of(std::uint16_t half) { return static_cast<real>(float_of(half)); }
template <class T>
real weighted_cell_of(const T* t, real x, real y, real z, real nx, real ny, real u, real v, real w) {
  const auto width = static_cast<long>(nx), height = static_cast<long>(ny);
  const T* p = t + static_cast<long>(x) + width * (static_cast<long>(y) + height * static_cast<long>(z));
  const auto row = [&](const T* q) { return fma(u, value_of(q[1]) - value_of(q[0]), value_of(q[0])); };
  const auto layer = [&](const T* q) { const real a = row(q); return fma(v, row(q + width) - a, a); };
  const real a = layer(p);
  return fma(w, layer(p + width * height) - a, a);
}
inline real weighted_cell(table t, real x, real y, real z, real nx, real ny, real u, real v, real w) {
  return weighted_cell_of(t, x, y, z, nx, ny, u, v, w);
}
inline real weighted_half_cell(table t, real x, real y, real z, real nx, real ny, real u, real v, real w) {
  return weighted_cell_of(reinterpret_cast<const std::uint16_t*>(t), x, y, z, nx, ny, u, v, w);
}
inline real exp_(real x) { return std::exp(x); }
inline real exp2_(real x) { return std::exp2(x); }
inline real log_(real x) { return std::log(x); }
inline real erf_(real x) { return std::erf(x); }
inline real atan_(real x) { return std::atan(x); }

#include "common/formulas/formulas.h"

#ifndef AIRLIGHT_EDITOR  // editor.h goes on with these words
#undef FORMULA
#undef OUT
#undef IN_LIST
#undef OUT_LIST
#undef IN_OUT_LIST
#undef EXACT
#endif
}  // namespace airlight::f64
