// Error functions of libraries, and our formulas in loops that the compiler turns into vectors. Built once for each instruction
// set: AIRLIGHT_TARGET is avx2 or avx512. Whatever is inline here and elsewhere has a name of its own, or the linker would take
// one of them for all.
#include "bench/erf.h"

#define AIRLIGHT_JOIN_(a, b) a##b
#define AIRLIGHT_JOIN(a, b) AIRLIGHT_JOIN_(a, b)

#define f32 AIRLIGHT_JOIN(f32_, AIRLIGHT_TARGET)
#include "common/formulas/float.h"

#ifdef AIRLIGHT_EIGEN
#define Eigen AIRLIGHT_JOIN(Eigen_, AIRLIGHT_TARGET)
#include <unsupported/Eigen/SpecialFunctions>
#endif
#ifdef AIRLIGHT_SLEEF
#include <immintrin.h>
#include <sleef.h>
#endif
#ifdef AIRLIGHT_XSIMD
#include <xsimd/xsimd.hpp>
#endif

namespace airlight {

namespace {

#ifdef __AVX512F__
const char* const target = "AVX-512";
#else
const char* const target = "AVX2";
#endif

#ifdef AIRLIGHT_EIGEN
void eigen_erf(const float* x, float* y, std::size_t n) {
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::Map<Eigen::ArrayXf>(y, size) = Eigen::Map<const Eigen::ArrayXf>(x, size).erf();
}
#endif

#ifdef AIRLIGHT_SLEEF
void sleef_erf(const float* x, float* y, std::size_t n) {
#ifdef __AVX512F__
  for (std::size_t i = 0; i < n; i += 16) _mm512_storeu_ps(y + i, Sleef_erff16_u10avx512f(_mm512_loadu_ps(x + i)));
#else
  for (std::size_t i = 0; i < n; i += 8) _mm256_storeu_ps(y + i, Sleef_erff8_u10avx2(_mm256_loadu_ps(x + i)));
#endif
}
#endif

#ifdef AIRLIGHT_XSIMD
void xsimd_erf(const float* x, float* y, std::size_t n) {
  using Batch = xsimd::batch<float>;
  for (std::size_t i = 0; i < n; i += Batch::size) xsimd::erf(Batch::load_unaligned(x + i)).store_unaligned(y + i);
}
#endif

template <int kind>
void erf_loop(const float* __restrict x, float* __restrict y, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) y[i] = f32::gaussian_erf(kind, x[i]).v;
}

void line_loop(const LineRays& rays, std::span<const LineGaussian> gaussians, float* __restrict depth) {
  const float* __restrict x = rays.x, * __restrict y = rays.y, * __restrict z = rays.z, * __restrict length = rays.length;
  for (std::size_t i = 0; i < rays.n; ++i) depth[i] = 0;
  for (const LineGaussian g : gaussians) {
    for (std::size_t i = 0; i < rays.n; ++i) {
      f32::real foot, h;
      f32::perpendicular(x[i], y[i], z[i], g.x, g.y, g.z, 0.0, foot, h);
      depth[i] += g.whole * f32::gaussian_depth(0, g.inverse, h, -foot, f32::real(length[i]) - foot).v;
    }
  }
}

}  // namespace

void AIRLIGHT_JOIN(add_others_, AIRLIGHT_TARGET)(ErfCandidates& all) {
#ifdef AIRLIGHT_EIGEN
  all.erf.push_back({"Eigen " AIRLIGHT_EIGEN, target, eigen_erf});
#endif
#ifdef AIRLIGHT_SLEEF
  all.erf.push_back({"SLEEF " AIRLIGHT_SLEEF ", 1.0 ULP", target, sleef_erf});
#endif
#ifdef AIRLIGHT_XSIMD
  all.erf.push_back({"xsimd " AIRLIGHT_XSIMD, target, xsimd_erf});
#endif
  all.erf.push_back({"ours, plain loop", target, erf_loop<0>});
  all.erf.push_back({"as printed, plain loop", target, erf_loop<1>});
  all.lines.push_back({"our formulas, plain loop", target, line_loop});
}

}  // namespace airlight
