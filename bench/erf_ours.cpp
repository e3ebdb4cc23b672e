// The error functions and line integrals of the kernels, and what the ports of a core give at most.
#include "bench/erf.h"
#include "cpu/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/erf_ours.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

template <int kind>
HWY_ATTR static void erf_over(const float* x, float* y, std::size_t n) {
  for (std::size_t i = 0; i < n; i += lanes) store(gaussian_erf(kind, load(x + i)), y + i);
}
static void erf_accurate(const float* x, float* y, std::size_t n) { erf_over<0>(x, y, n); }
static void erf_fast(const float* x, float* y, std::size_t n) { erf_over<1>(x, y, n); }

template <int kind>
HWY_ATTR static void lines_over(const LineRays& rays, std::span<const LineGaussian> gaussians, float* depth) {
  for (std::size_t i = 0; i < rays.n; i += lanes) {
    const Real dx = load(rays.x + i), dy = load(rays.y + i), dz = load(rays.z + i), length = load(rays.length + i);
    Real sum = 0.0;
    for (const LineGaussian& g : gaussians) {
      Real foot, h;
      perpendicular(dx, dy, dz, g.x, g.y, g.z, 0.0, foot, h);
      sum = fma(gaussian_depth(kind, g.inverse, h, -foot, length - foot), g.whole, sum);
    }
    store(sum, depth + i);
  }
}
static void lines_accurate(const LineRays& r, std::span<const LineGaussian> g, float* depth) { lines_over<0>(r, g, depth); }
static void lines_fast(const LineRays& r, std::span<const LineGaussian> g, float* depth) { lines_over<1>(r, g, depth); }

// Twelve streams, each its own: more than a port's latency in operations.
constexpr std::size_t streams = 12, rounds = 500;
template <class Next>
HWY_INLINE std::size_t results_of(float* keep, Next&& next) {
  Real s[streams];
  for (std::size_t k = 0; k < streams; ++k) s[k] = load(keep) + static_cast<float>(k);
  for (std::size_t n = 0; n < rounds; ++n) {
    for (Real& one : s) one = next(one);
  }
  for (std::size_t k = 1; k < streams; ++k) s[0] += s[k];
  store(s[0], keep + lanes);
  return streams * rounds * lanes;
}
static std::size_t fma_limit(float* keep) {
  const Real factor = load(keep);
  return results_of(keep, [&](Real x) HWY_ATTR { return fma(x, factor, factor); });
}
static std::size_t sqrt_limit(float* keep) {
  return results_of(keep, [&](Real x) HWY_ATTR { return sqrt(x); });
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(erf_accurate);
HWY_EXPORT(erf_fast);
HWY_EXPORT(lines_accurate);
HWY_EXPORT(lines_fast);
HWY_EXPORT(fma_limit);
HWY_EXPORT(sqrt_limit);

void add_ours(ErfCandidates& all) {
  for (const Simd simd : available_simd()) {
    const std::string target(name_of(simd));
    all.erf.push_back({"ours", target, entry(HWY_DISPATCH_TABLE(erf_accurate), simd)});
    all.erf.push_back({"ours, as printed", target, entry(HWY_DISPATCH_TABLE(erf_fast), simd)});
    all.lines.push_back({"ours", target, entry(HWY_DISPATCH_TABLE(lines_accurate), simd)});
    all.lines.push_back({"ours, erf as printed", target, entry(HWY_DISPATCH_TABLE(lines_fast), simd)});
    if (simd == Simd::scalar) continue;  // its std::fma is a call
    all.limits.push_back({"fma", target, entry(HWY_DISPATCH_TABLE(fma_limit), simd)});
    all.limits.push_back({"sqrt", target, entry(HWY_DISPATCH_TABLE(sqrt_limit), simd)});
  }
}

}  // namespace airlight
#endif
