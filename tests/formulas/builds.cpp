#include "tests/formulas/builds.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/formulas/builds.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

static void point_airlight_over(Phase phase, const float* tables, const float* const in[5], float* out, std::size_t n) {
  for (std::size_t i = 0; i < n; i += lanes) {
    store(point_airlight(tables, static_cast<int>(phase.kind), static_cast<float>(phase.g), load(in[0] + i), load(in[1] + i), load(in[2] + i),
                         load(in[3] + i), load(in[4] + i)),
          out + i);
  }
}
static void phase_value_over(Phase phase, const float* mu, float* out, std::size_t n) {
  for (std::size_t i = 0; i < n; i += lanes) store(phase_value(static_cast<int>(phase.kind), static_cast<float>(phase.g), load(mu + i)), out + i);
}
static void exp_over(const float* x, float* out, std::size_t n) {
  for (std::size_t i = 0; i < n; i += lanes) store(exp_(load(x + i)), out + i);
}
static void log_over(const float* x, float* out, std::size_t n) {
  for (std::size_t i = 0; i < n; i += lanes) store(log_(load(x + i)), out + i);
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "common/formulas/float.h"

namespace airlight {

HWY_EXPORT(point_airlight_over);
HWY_EXPORT(phase_value_over);
HWY_EXPORT(exp_over);
HWY_EXPORT(log_over);

namespace {

// A whole number of the widest vectors; what is added is a copy of the last value.
std::vector<float> padded(std::span<const float> values) {
  std::vector<float> all(values.begin(), values.end());
  while (all.size() % 16 != 0) all.push_back(all.back());
  return all;
}

template <class Over>
std::vector<float> over(std::span<const float> x, Over&& run) {
  const std::vector<float> in = padded(x);
  std::vector<float> out(in.size());
  run(in.data(), out.data(), in.size());
  out.resize(x.size());
  return out;
}

}  // namespace

std::vector<float> point_airlight_float(Phase phase, std::span<const float> tables, const PointAirlightInputs& in) {
  std::vector<float> out;
  for (std::size_t i = 0; i < in.size(); ++i) {
    out.push_back(f32::point_airlight(tables.data(), static_cast<int>(phase.kind), static_cast<float>(phase.g), in.extinction[i], in.foot[i],
                                      in.h[i], in.x0[i], in.x1[i]).v);
  }
  return out;
}

std::vector<float> point_airlight_simd(Phase phase, std::span<const float> tables, const PointAirlightInputs& in, Simd simd) {
  const std::vector<float> a = padded(in.extinction), b = padded(in.foot), c = padded(in.h), d = padded(in.x0), e = padded(in.x1);
  const float* const pointers[] = {a.data(), b.data(), c.data(), d.data(), e.data()};
  std::vector<float> out(a.size());
  entry(HWY_DISPATCH_TABLE(point_airlight_over), simd)(phase, tables.data(), pointers, out.data(), out.size());
  out.resize(in.size());
  return out;
}

std::vector<float> phase_value_simd(Phase phase, std::span<const float> mu, Simd simd) {
  return over(mu, [&](const float* x, float* y, std::size_t n) { entry(HWY_DISPATCH_TABLE(phase_value_over), simd)(phase, x, y, n); });
}
std::vector<float> exp_simd(std::span<const float> x, Simd simd) { return over(x, entry(HWY_DISPATCH_TABLE(exp_over), simd)); }
std::vector<float> log_simd(std::span<const float> x, Simd simd) { return over(x, entry(HWY_DISPATCH_TABLE(log_over), simd)); }

}  // namespace airlight
#endif
