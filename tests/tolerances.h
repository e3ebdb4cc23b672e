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
