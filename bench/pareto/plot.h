// Time against error as a figure.
#pragma once

#include <string>

#include "bench/pareto/measure.h"

namespace airlight {

// Logarithmic axes, a colour a technique, a marker a backend, the fronts as lines and their points labelled by their knobs.
// `name`.svg and `name`.png appear when complete. Throws MachineError where they cannot be written.
void draw(const Measurement&, const std::string& title, const std::string& name);

}  // namespace airlight
