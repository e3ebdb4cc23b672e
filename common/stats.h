// What a frame cost, counted where it happens and printed by --stats.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace airlight {

struct StepStats {
  std::string name;
  double seconds = 0;       // thread time summed over the workers on the CPU, wall time (glFinish) on GL
  std::uint64_t items = 0;  // pixels or triangles processed
  bool reused = false;      // its kept outputs were up to date
  std::string note = {};    // where its result comes from, or was kept; empty: nothing to tell
  // Of a step that iterates: the change in each round, beside the sum of what it changes; about what all further rounds would
  // change, and whether that is as little as was asked for.
  std::vector<float> residuals = {};
  float left_out = 0;
  bool converged = true;
  std::uint64_t bytes = 0;  // of the images and buffers that the backend held when the step ended
};

struct Stats {
  std::vector<StepStats> steps;
  double seconds = 0;  // wall time of run()
};

}  // namespace airlight
