// Time against error as a figure.
#pragma once

#include <string>

#include "bench/pareto/measure.h"
#include "bench/pareto/origin.h"

namespace airlight {

// Bytes of two files of the same figure.
struct Figure {
  std::string svg, png;
};

// Logarithmic axes, a colour a technique, a marker a backend, the front of each backend as a line, its points filled and labelled
// by those of their knobs that differ, the others hollow. The same arguments give the same bytes (with the same fonts installed).
Figure figure_of(const Measurement&, const Origin&);

}  // namespace airlight
