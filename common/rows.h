// A band of rows of an image.
#pragma once

#include <algorithm>
#include <limits>

namespace airlight {

// Rows of an image from the top, `first` to before `end`. Those that an image has not are none of it: the default is all of any.
struct Rows {
  int first = 0, end = std::numeric_limits<int>::max();

  constexpr int count() const { return std::max(end - first, 0); }
  friend bool operator==(const Rows&, const Rows&) = default;
};

// Of an image of that height.
constexpr Rows within(Rows rows, int height) { return {std::clamp(rows.first, 0, height), std::clamp(rows.end, 0, height)}; }

// The least range that holds both; rows of no count add nothing.
constexpr Rows united(Rows a, Rows b) {
  if (a.count() == 0) return b;
  if (b.count() == 0) return a;
  return {std::min(a.first, b.first), std::max(a.end, b.end)};
}

}  // namespace airlight
