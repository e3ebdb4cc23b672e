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
  std::vector<float> table = {};
  double share = 1;  // of the calls that are asked for, where the truth takes long
  int rises = 0;     // 1: its first result never falls where input `along` grows; -1: never rises
  std::size_t along = 0;
};

std::vector<StressedFormula> stressed_formulas();
void add_integrals(std::vector<StressedFormula>&);  // those of which the truth is a quadrature
std::string text_of(const std::vector<double>& inputs);

struct FormulaStress {
  Measured measured;           // of the float build
  std::size_t not_finite = 0;  // results
  std::size_t other_bits = 0;  // calls in which a SIMD target gives other bits
};

// So many calls from a stream of numbers, beside the special ones.
FormulaStress stress(const StressedFormula&, std::uint32_t stream, std::size_t calls);

struct Monotony {
  std::size_t pairs = 0, back = 0;  // of neighbouring floats, and those in which the result steps back
  Measured largest;                 // step back, beside what the formula's error is told
};

// Neighbours of so many places and of the special ones, of a formula that only rises or falls.
Monotony monotony(const StressedFormula&, std::uint32_t stream, std::size_t places);

}  // namespace airlight
