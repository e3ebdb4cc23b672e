// Closed forms over their whole domains in single precision: logarithmically even, special values, neighbours of branch points.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/formulas/checks/check.h"
#include "tests/stability/draw.h"

namespace airlight {

struct StressedFormula {
  std::string name;
  Formula formula;
  Phase phase;
  std::string domain;                         // for the table of docs/NUMERICS.md
  std::function<void(Draw&, Columns&)> draw;  // adds one call
  std::function<void(Columns&)> special;      // adds calls at the ends of the domain and beside its branches
  std::function<std::vector<double>(const std::vector<double>&)> truth;  // of each result that is looked at
  std::string scale;                                                     // beside what the error is told
  std::function<double(const std::vector<double>&, double)> scale_of;    // by the inputs and the truth
  std::string_view bound;                                                // row of tests/tolerances.h
};

std::vector<StressedFormula> stressed_formulas();

struct FormulaStress {
  Measured measured;           // of the float build
  std::size_t not_finite = 0;  // results
  std::size_t other_bits = 0;  // calls in which a SIMD target gives other bits
};

// So many calls from a stream of numbers, beside the special ones.
FormulaStress stress(const StressedFormula&, std::uint32_t stream, std::size_t calls);

}  // namespace airlight
