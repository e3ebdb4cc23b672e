// Which of the measured points are worth having.
#pragma once

#include <vector>

#include "bench/pareto/sweep.h"
#include "bench/pareto/truth.h"
#include "common/techniques/goal.h"

namespace airlight {

struct Point {
  Configuration configuration;
  RelativeError error;    // at the truth's extent
  double small_ms = 0;    // median frame at that extent
  double ms = 0;          // median frame at full size; 0: not timed there
  bool on_front = false;  // of its backend: nothing is both faster and nearer to the truth
};

// Marks what is on the front among the timed points of each backend. Equal points are on it together.
void mark_fronts(std::vector<Point>&);

// Worth timing at full size, judged by small_ms: what no other configuration of its technique and backend beats in error while it
// takes less than the time divided by `slack` (>= 1, for the noise of times and for what grows with the size).
std::vector<bool> near_front(const std::vector<Point>&, double slack);

// For an error: the fastest timed point that has at most that; for a time: the most exact one that takes at most that. Null where
// there is none.
const Point* chosen(const std::vector<Point>&, const Goal&);

// What comes nearest to a goal that nothing meets: the most exact, or the fastest. Null where nothing was timed.
const Point* nearest(const std::vector<Point>&, const Goal&);

}  // namespace airlight
