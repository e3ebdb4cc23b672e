// Measurements as CSV and JSON.
#pragma once

#include <string>

#include "bench/pareto/measure.h"
#include "bench/pareto/origin.h"

namespace airlight {

// A header, then a row a configuration: scene, technique, backend, a column for each knob that is swept, error, error_off_edges
// (ratios), ms, small_ms, on_front (0 or 1). Empty: a knob that the technique does not have, a time that was not measured.
std::string csv_of(const Measurement&, const Origin&);

// The same with its origin and with what was left out.
std::string json_of(const Measurement&, const Origin&);

// Quoted where RFC 4180 asks for it.
std::string csv_field(const std::string&);
// With its quotes; RFC 8259.
std::string json_string(const std::string&);

}  // namespace airlight
