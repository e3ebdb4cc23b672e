// What a frame cost, counted where it happens and printed by --stats.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace airlight {

struct StepInput {
  std::string_view name;  // of the step's field
  int step = -1;          // that makes it, by its place in the plan; -1: it is uploaded
};

// What a step works through to make its items, counted where it is passed over: triangles, for instance.
struct StepParts {
  std::uint64_t all = 0, skipped = 0;
  std::string_view name = {}, why = {};  // plural; of those that are skipped
};

struct StepStats {
  std::string name;
  double seconds = 0;       // thread time summed over the workers on the CPU, wall time (glFinish) on GL
  std::uint64_t items = 0;  // pixels, or floats of buffers, that it made
  bool reused = false;      // it was not run: its kept outputs were up to date
  std::string note = {};    // where its result comes from, or was kept; empty: nothing to tell
  // Of a step that iterates: the change in each round, beside the sum of what it changes; about what all further rounds would
  // change, and whether that is as little as was asked for.
  std::vector<float> residuals = {};
  float left_out = 0;
  bool converged = true;
  std::uint64_t held = 0;  // [byte] of the images and buffers that the backend held when the step ended
  // What the plan tells of it.
  std::string_view why = {};           // it is there
  std::vector<StepInput> inputs = {};  // in order of the fields
  std::uint64_t bytes = 0;             // of all that it makes
  // Items that it left as they were, or, of a step that ran, was done with before its work on them began. Of such a step
  // counted where `counted`, as vectors and squares are passed over as a whole; unknown else.
  std::uint64_t skipped = 0;
  bool counted = false;
  std::string_view why_skipped = {};  // of a step that ran; empty: it never passes over an item
  StepParts parts = {};               // none: it passes over nothing else
  double estimate = 0;                // [s] of thread time on the CPU, before it ran
  bool asked = true;                  // else it was not run because nothing that ran reads it
};

// What the plan left out.
struct SkipStats {
  std::string rule, what, why;  // a name of common/plan/rules.h, and two phrases
};

struct Stats {
  std::vector<StepStats> steps;
  std::vector<SkipStats> skips;
  double seconds = 0;  // wall time of run()
};

}  // namespace airlight
