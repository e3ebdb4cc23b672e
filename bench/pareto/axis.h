// Logarithmic axes of a figure.
#pragma once

#include <string>
#include <vector>

namespace airlight {

// From one value to another (both > 0), at two places of the figure.
struct LogAxis {
  double least = 1, most = 10;  // values
  double from = 0, to = 1;      // their places [pixel]
  double operator()(double v) const;
};

// Around all of the values with some room, at least half a power of ten long.
LogAxis axis_over(const std::vector<double>& values, double from, double to);

struct Tick {
  double value;
  std::string label;   // empty: a line only
  bool power = false;  // of ten
};

// At 1 to 9 times each power of ten within the axis, or at powers of ten alone on a very long one; numbers at as many of them as
// leave room.
std::vector<Tick> ticks(const LogAxis&);

}  // namespace airlight
