// What one writes first: the C library's functions in a loop, with -ffast-math, so that the compiler calls their vector versions.
// Built once for each instruction set: AIRLIGHT_TARGET is avx2 or avx512.
#include <cmath>

#include "bench/erf.h"

#define AIRLIGHT_JOIN_(a, b) a##b
#define AIRLIGHT_JOIN(a, b) AIRLIGHT_JOIN_(a, b)

namespace airlight {

namespace {

#ifdef __AVX512F__
const char* const target = "AVX-512";
#else
const char* const target = "AVX2";
#endif

void erf_loop(const float* __restrict x, float* __restrict y, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) y[i] = std::erf(x[i]);
}

void line_loop(const LineRays& rays, std::span<const LineGaussian> gaussians, float* __restrict depth) {
  const float* __restrict x = rays.x, * __restrict y = rays.y, * __restrict z = rays.z, * __restrict length = rays.length;
  for (std::size_t i = 0; i < rays.n; ++i) depth[i] = 0;
  for (const LineGaussian g : gaussians) {
    const float distance_squared = g.x * g.x + g.y * g.y + g.z * g.z;
    for (std::size_t i = 0; i < rays.n; ++i) {
      const float foot = x[i] * g.x + y[i] * g.y + z[i] * g.z;
      const float h_squared = distance_squared - foot * foot;
      depth[i] += 0.5F * g.whole * std::exp(-h_squared * g.inverse * g.inverse) *
                  (std::erf((length[i] - foot) * g.inverse) - std::erf(-foot * g.inverse));
    }
  }
}

}  // namespace

void AIRLIGHT_JOIN(add_plain_, AIRLIGHT_TARGET)(ErfCandidates& all) {
  all.erf.push_back({"glibc in vectors", target, erf_loop});
  all.lines.push_back({"exp and erf of glibc, plain loop", target, line_loop});
}

}  // namespace airlight
