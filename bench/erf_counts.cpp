// A build of the formula dialect (common/formulas/README.md) whose numbers count what is done to them.
#include "bench/erf_counts.h"

namespace airlight {

namespace counted {

OperationCounts counts;

struct Counted {
  Counted() = default;
  Counted(double) {}
  Counted& operator+=(Counted) {
    ++counts.others;
    return *this;
  }
};
struct Condition {};
using real = Counted;
using mask = Condition;
real multiplied() {
  ++counts.multiplications;
  return {};
}
real other() {
  ++counts.others;
  return {};
}
mask compared() {
  ++counts.others;
  return {};
}
real operator*(real, real) { return multiplied(); }
real operator/(real, real) {
  ++counts.roots;
  return {};
}
real operator+(real, real) { return other(); }
real operator-(real, real) { return other(); }
real operator-(real) { return other(); }
mask operator<(real, real) { return compared(); }
mask operator>(real, real) { return compared(); }
real fma(real, real, real) { return multiplied(); }
real sqrt(real) {
  ++counts.roots;
  return {};
}
real min(real, real) { return other(); }
real max(real, real) { return other(); }
real select(mask, real, real) { return other(); }
real round_even(real) { return other(); }
real exp2_int(real) {
  counts.others += 3;
  return {};
}  // to integers, an addition, a shift
real exponent_of(real) { return other(); }
real mantissa_of(real) { return other(); }

#define FORMULA [[maybe_unused]] static
#define OUT(type) type&
#define EXACT
#include "common/formulas/elementary.h"
#include "common/formulas/gaussian.h"
#undef FORMULA
#undef OUT
#undef EXACT

}  // namespace counted

OperationCounts count_erf(int kind) {
  counted::counts = {};
  counted::gaussian_erf(kind, {});
  return counted::counts;
}

OperationCounts count_line(int kind) {
  // perpendicular() stands among the formulas of the camera: three products by dx, dy, dz, three by the foot, three squares; max;
  // their root.
  counted::counts = {9, 1, 1};
  const counted::real length, foot;
  counted::gaussian_depth(kind, {}, {}, -foot, length - foot);
  counted::fma({}, {}, {});
  return counted::counts;
}

}  // namespace airlight
