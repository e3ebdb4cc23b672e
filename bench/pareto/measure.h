// Time and error of every configuration of a scene.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/pareto/deadline.h"
#include "bench/pareto/front.h"
#include "bench/pareto/truth.h"

namespace airlight {

struct MeasureOptions {
  std::vector<std::string> backends{"cpu", "gl"}, techniques;  // techniques: all that support the scene where it is empty
  std::string simd = "auto";
  Extent extent, truth_extent{160, 120};
  int threads = 0;          // 0: as many as there are
  int repeats = 5;          // timed frames of each
  double longest = 2;       // [s] a frame that takes longer is timed once
  bool everything = false;  // time every configuration at full size, not only those near a front
};

struct Measurement {
  std::vector<Point> points;                   // in the order of the sweep
  std::map<std::string, std::string> devices;  // backend, Renderer::describe()
  std::vector<std::string> left_out;           // what could not be measured, each with its reason
};

// First the error of every configuration and its time at the truth's size; then, of those near a front, the time at full size:
// one visit after the other, again and again, so that what else the machine does hits all alike. When the deadline comes, what
// has been measured is given back. Throws MachineError where no backend starts, InputError where no technique renders the scene.
Measurement measure(const Scene&, const Truth&, const MeasureOptions&, Deadline&);

}  // namespace airlight
