// Measurements as CSV and JSON.
#pragma once

#include <string>

#include "bench/pareto/measure.h"

namespace airlight {

// What was measured where, for the head of a file.
struct Origin {
  std::string scene, commit, machine;
  Extent extent, truth_extent;
};

// "AMD EPYC, 2 cores"
std::string machine_name();

// A row a configuration: scene, technique, backend, knobs, error, error_off_edges, ms, small_ms, on_front.
std::string csv_of(const Measurement&, const Origin&);
std::string json_of(const Measurement&, const Origin&);

}  // namespace airlight
