// Every tolerance of the tests, with its reason. Comparisons are written so that NaN fails: !(error <= tolerance).
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace airlight {

struct Tolerance {
  std::string_view name;
  double value;
  std::string_view reason;
};

inline constexpr Tolerance tolerances[] = {
    {"airlight_double", 1e-8, "relative; the adaptive quadrature that serves as oracle, against the high-precision table"},
    {"airlight_value", 2e-5, "relative to the value: interpolation in the tables at their default size"},
    {"airlight_end", 1e-7, "relative to the larger end value B or B': the difference of two floats is known no better"},
    {"airlight_interpolation", 4e-5, "relative to the value and the end values: cubic interpolation of the tables, |g| <= 0.97"},
    {"airlight_interpolation_peak", 1e-3, "the same for |g| up to 0.99, whose peak is 1/100 rad wide: 256 nodes leave this"},
    {"phase_integral", 5e-6, "of a phase function over the sphere; the float mu near a peak of |g| = 0.99 is worth 3e-6"},
    {"phase_value", 2.5e-6, "relative, float against double: eighth and 32nd powers of 1 + mu and quotients at a peak magnify roundings"},
    {"exp_ulp", 2.5, "ULP of exp_: rounding of its polynomial and of the reduced argument"},
    {"log_ulp", 2.5, "ULP of log_ away from 1, where its value is small in absolute terms"},
    {"parity_off_edges", 0.0002,
     "share of pixels: where triangles are smaller than 1/10 pixel that rounding also picks a neighbour on smooth surfaces"},
    {"parity_edge_share", 0.002,
     "CPU and GL round projected vertices to 1/256 pixel from differently rounded floats: pixels on an edge may see the other side"},
};

inline double tolerance(std::string_view name) {
  for (const Tolerance& t : tolerances) {
    if (t.name == name) return t.value;
  }
  throw std::logic_error("no such tolerance: " + std::string(name));
}

}  // namespace airlight
