// What a step is about to cost, for --explain: counted from its own fields, with nanoseconds that were fitted to docs/RESULTS.md.
// Rough: what is in the way of a ray is not known before it is asked. Shadow planes of fine meshes take many times as long in
// small images.
#pragma once

#include <cstdint>

#include "common/algorithms/algorithm.h"

namespace airlight {

struct StepCost {
  std::uint64_t items = 0;  // pixels of the image, or floats of the buffers, that it makes
  std::uint64_t bytes = 0;  // of all that it makes, as a backend keeps it
  double seconds = 0;       // thread time on the CPU of docs/RESULTS.md, AVX-512
};
StepCost cost_of(const Algorithm&);

}  // namespace airlight
