// Time and error of configurations.
#pragma once

#include <string>
#include <vector>

#include "bench/pareto/sweep.h"
#include "bench/pareto/truth.h"

namespace airlight {

struct MeasureOptions {
  std::vector<std::string> backends{"cpu", "gl"}, techniques;  // techniques: all that support the scene where it is empty
  Extent extent, truth_extent{160, 120};
  int threads = 0;          // 0: as many as there are
  int repeats = 5;          // counted frames of each
  double longest = 2;       // [s] a frame that takes longer is timed once
  double limit = 1e30;      // [s] no further round of frames begins after it
  bool everything = false;  // time every configuration at full size, not only those near a front
};

struct Point {
  Configuration configuration;
  RelativeError error;    // at truth_extent
  double small_ms = 0;    // median frame at truth_extent
  double ms = 0;          // median frame at extent; 0: not timed there
  bool on_front = false;  // of its backend: nothing is both faster and nearer to the truth
};

struct Measurement {
  std::vector<Point> points;
  std::vector<std::string> devices;   // of the backends that ran
  std::vector<std::string> left_out;  // techniques and backends that cannot, with their reason
};

Measurement measure(const Scene&, const Truth&, const MeasureOptions&, Progress&);

// Marks what is on the front among the timed points of each backend.
void mark_fronts(std::vector<Point>&);

// Whether no other configuration of the backend is as good and takes less than a part of the time, at the small size: worth a
// measurement at full size.
std::vector<bool> near_front(const std::vector<Point>&, double part);

// The cheapest timed point with at most this error, or the most exact one within this time; null where there is none.
const Point* cheapest_within_error(const std::vector<Point>&, double error);
const Point* best_within_time(const std::vector<Point>&, double ms);

}  // namespace airlight
