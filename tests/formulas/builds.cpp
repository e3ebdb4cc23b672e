#include "tests/formulas/builds.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/formulas/builds.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

#define FORMULA HWY_INLINE
#define OUT(type) type&
#define INPUTS const real* a
#define RESULTS real* r
#include "tests/formulas/calls.h"
#undef FORMULA
#undef OUT
#undef INPUTS
#undef RESULTS

// Columns of a whole number of the widest vectors.
static void call_over(int formula, const float* t, int kind, float g, const std::vector<std::vector<float>>& inputs,
                      std::vector<std::vector<float>>& results) {
  for (std::size_t i = 0; i < results[0].size(); i += lanes) {
    Real a[most_inputs], r[most_results];
    for (std::size_t k = 0; k < most_inputs; ++k) a[k] = k < inputs.size() ? load(inputs[k].data() + i) : Real(0.0);
    for (Real& one : r) one = 0.0;
    call_formula(formula, t, kind, g, a, r);
    for (std::size_t k = 0; k < most_results; ++k) store(r[k], results[k].data() + i);
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "common/formulas/double.h"
#include "common/formulas/float.h"

#define FORMULA inline
#define OUT(type) type&
#define INPUTS const real* a
#define RESULTS real* r
namespace airlight::f64 {
#include "tests/formulas/calls.h"
}
namespace airlight::f32 {
#include "tests/formulas/calls.h"
}

namespace airlight {

HWY_EXPORT(call_over);

Columns run_double(const Calls& calls) {
  const std::size_t n = calls.inputs[0].size();
  Columns results(most_results, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    double a[most_inputs] = {}, r[most_results] = {};
    for (std::size_t k = 0; k < calls.inputs.size(); ++k) a[k] = calls.inputs[k][i];
    f64::call_formula(static_cast<int>(calls.formula), calls.table.data(), static_cast<int>(calls.phase.kind), calls.phase.g, a,
                      r);
    for (std::size_t k = 0; k < most_results; ++k) results[k][i] = r[k];
  }
  return results;
}

Columns run_float(const Calls& calls) {
  const std::size_t n = calls.inputs[0].size();
  Columns results(most_results, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    f32::Float a[most_inputs], r[most_results];
    for (std::size_t k = 0; k < calls.inputs.size(); ++k) a[k] = calls.inputs[k][i];
    f32::call_formula(static_cast<int>(calls.formula), calls.table.data(), static_cast<int>(calls.phase.kind), calls.phase.g, a,
                      r);
    for (std::size_t k = 0; k < most_results; ++k) results[k][i] = static_cast<double>(r[k].v);
  }
  return results;
}

Columns run_simd(const Calls& calls, Simd simd) {
  const std::size_t n = calls.inputs[0].size(), padded = (n + 15) / 16 * 16;
  std::vector<std::vector<float>> inputs, results(most_results, std::vector<float>(padded));
  for (const std::vector<double>& column : calls.inputs) {
    inputs.emplace_back(column.begin(), column.end());
    inputs.back().resize(padded, inputs.back().back());  // what is added is a copy of the last call
  }
  entry(HWY_DISPATCH_TABLE(call_over), simd)(static_cast<int>(calls.formula), calls.table.data(),
                                             static_cast<int>(calls.phase.kind), static_cast<float>(calls.phase.g), inputs,
                                             results);
  Columns columns;
  for (const std::vector<float>& column : results)
    columns.emplace_back(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(n));
  return columns;
}

}  // namespace airlight
#endif
