// How many operations the formulas take, counted by running them.
#pragma once

namespace airlight {

struct OperationCounts {
  int multiplications = 0;  // fused multiply-adds among them: one port does both
  int others = 0;           // sums, comparisons, selections, conversions
  int roots = 0;            // square roots and quotients
};

// An error function by gaussian_erf(), and what bench/erf_ours.cpp does for a Gaussian and a ray.
OperationCounts count_erf(int kind);
OperationCounts count_line(int kind);

}  // namespace airlight
