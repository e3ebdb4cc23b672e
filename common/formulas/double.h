// The double-precision build of the formulas, namespace airlight::f64 (see README.md in this folder).
#pragma once

#include <cmath>

namespace airlight::f64 {

using real = double;
using mask = bool;
using table = const float*;
#define FORMULA inline
#define OUT(type) type&

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
inline real exp_(real x) { return std::exp(x); }
inline real log_(real x) { return std::log(x); }

#include "common/formulas/formulas.h"

#undef FORMULA
#undef OUT
}  // namespace airlight::f64
