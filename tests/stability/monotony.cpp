// Where the mathematics only rises or only falls, neighbouring floats may step back by a rounding and no more.
#include <algorithm>
#include <cmath>

#include "tests/formulas/builds.h"
#include "tests/stability/formula_stress.h"

namespace airlight {

namespace {
constexpr int steps = 16;  // to either side of a number
}

Monotony monotony(const StressedFormula& f, std::uint32_t stream, std::size_t places) {
  Columns around;
  f.special(around);
  Draw draw(stream);
  for (std::size_t i = 0; i < places; ++i) f.draw(draw, around);

  Calls asked{f.formula, Columns(around.size()), f.phase, f.table};
  for (std::size_t i = 0; i < around[0].size(); ++i) {
    const auto here = static_cast<float>(around[f.along][i]);
    float x = here;
    for (int k = 0; k < steps; ++k) x = std::nextafterf(x, -HUGE_VALF);
    for (int k = -steps; k <= steps; ++k, x = std::nextafterf(x, HUGE_VALF)) {
      // Within the domain: on the number's own side of 0.
      const bool inside = std::isfinite(x) && (x > 0) == (here > 0) && (x < 0) == (here < 0);
      for (std::size_t column = 0; column < around.size(); ++column)
        asked.inputs[column].push_back(column == f.along && inside ? static_cast<double>(x) : around[column][i]);
    }
  }
  const Columns found = run_float(asked);
  Monotony result;
  const std::size_t n = asked.inputs[0].size();
  std::vector<double> inputs(asked.inputs.size());
  for (std::size_t i = 1; i < n; ++i) {
    if (i % (2 * steps + 1) == 0 || !(asked.inputs[f.along][i] > asked.inputs[f.along][i - 1])) continue;
    for (std::size_t k = 0; k < inputs.size(); ++k) inputs[k] = asked.inputs[k][i];
    ++result.pairs;
    const double back = (found[0][i - 1] - found[0][i]) * f.rises;
    result.back += back > 0 ? 1 : 0;
    result.largest.add(std::max(back, 0.0) / f.scale_of(inputs, std::fabs(found[0][i])), [&] { return text_of(inputs); });
  }
  return result;
}

}  // namespace airlight
