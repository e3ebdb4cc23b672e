// The single-precision build of the formulas, namespace airlight::f32 (see README.md in this folder).
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "common/half.h"

namespace airlight::f32 {

// A float that literals of type double may enter but that never widens by itself.
struct Float {
  float v;
  Float() : v(0) {}
  Float(double x) : v(static_cast<float>(x)) {}
  Float(float x) : v(x) {}
  Float(int x) : v(static_cast<float>(x)) {}
  Float& operator+=(Float b) { v += b.v; return *this; }
  Float& operator-=(Float b) { v -= b.v; return *this; }
  Float& operator*=(Float b) { v *= b.v; return *this; }
};
inline Float operator+(Float a, Float b) { return a.v + b.v; }
inline Float operator-(Float a, Float b) { return a.v - b.v; }
inline Float operator*(Float a, Float b) { return a.v * b.v; }
inline Float operator/(Float a, Float b) { return a.v / b.v; }
inline Float operator-(Float a) { return -a.v; }
inline bool operator<(Float a, Float b) { return a.v < b.v; }
inline bool operator<=(Float a, Float b) { return a.v <= b.v; }
inline bool operator>(Float a, Float b) { return a.v > b.v; }
inline bool operator>=(Float a, Float b) { return a.v >= b.v; }

using real = Float;
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
inline real sqrt(real x) { return std::sqrt(x.v); }
inline real abs(real x) { return std::fabs(x.v); }
inline real min(real a, real b) { return a.v < b.v ? a : b; }
inline real max(real a, real b) { return a.v > b.v ? a : b; }
inline real floor(real x) { return std::floor(x.v); }
inline real fma(real a, real b, real c) { return std::fma(a.v, b.v, c.v); }
inline real round_even(real x) { return std::nearbyint(x.v); }
inline real exp2_int(real n) { return std::bit_cast<float>((static_cast<std::int32_t>(n.v) + 127) << 23); }
inline real exponent_of(real x) { return static_cast<float>((std::bit_cast<std::int32_t>(x.v) >> 23) - 127); }
inline real mantissa_of(real x) { return std::bit_cast<float>((std::bit_cast<std::int32_t>(x.v) & 0x007fffff) | 0x3f800000); }
inline real fetch(table t, real i) { return t[static_cast<std::int32_t>(i.v)]; }
inline real element(table t, int i) { return t[i]; }
inline int integer_element(table t, int i) { return static_cast<int>(t[i]); }
// sum_ik a_i b_k t[at + i stride + k], i and k in 0..3.
inline real weighted_patch(table t, real at, int stride, real a0, real a1, real a2, real a3, real b0, real b1, real b2, real b3) {
  const float* p = t + static_cast<long>(at.v);
  const auto row = [&](const float* q) { return fma(b0, real(q[0]), fma(b1, real(q[1]), fma(b2, real(q[2]), b3 * real(q[3])))); };
  return fma(a0, row(p), fma(a1, row(p + stride), fma(a2, row(p + 2 * stride), a3 * row(p + 3 * stride))));
}
// The value at (x + u, y + v, z + w) between eight elements of a box in a table, x fastest: element (x, y, z) is number
// x + nx (y + ny z). Lower corners and sizes are integral; linear an axis at a time, x first.
inline real value_of(float x) { return x; }
inline real value_of(std::uint16_t half) { return float_of(half); }
template <class T>
real weighted_cell_of(const T* t, real x, real y, real z, real nx, real ny, real u, real v, real w) {
  const auto width = static_cast<long>(nx.v), height = static_cast<long>(ny.v);
  const T* p = t + static_cast<long>(x.v) + width * (static_cast<long>(y.v) + height * static_cast<long>(z.v));
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

#include "common/formulas/elementary.h"
#include "common/formulas/formulas.h"

#undef FORMULA
#undef OUT
#undef IN_LIST
#undef OUT_LIST
#undef IN_OUT_LIST
#undef EXACT
}  // namespace airlight::f32
