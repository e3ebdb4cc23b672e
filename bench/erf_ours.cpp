// The error functions and line integrals of the kernels, and what the ports of a core give at most.
#include "bench/erf.h"
#include "cpu/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/erf_ours.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

// What was tried beside the quotient of erf_ and not taken (docs/RESULTS.md): minimax polynomials of degree 4 about x = i / 4,
// i = 0..15, the first one through 0, held from 3.87 on. Constants by a permutation of lanes, which for AVX2 takes two and a
// blend.
constexpr float piece_constants[5][16] = {
    {0.0F, 0.2763264F, 0.5204999F, 0.71115565F, 0.8427008F, 0.92290014F, 0.96610516F, 0.9866717F, 0.9953223F, 0.9985373F,
     0.999593F, 0.9998994F, 0.9999779F, 0.9999957F, 0.9999993F, 0.9999999F},
    {0.28209433F, 0.265002F, 0.21969551F, 0.16073377F, 0.10377818F, 0.05913118F, 0.029732857F, 0.013193626F, 0.0051664985F,
     0.0017853768F, 0.0005444542F, 0.0001465165F, 3.4793717e-05F, 7.2912026e-06F, 1.3482668e-06F, 2.20001e-07F},
    {9.191166e-06F, -0.016562222F, -0.027461369F, -0.030137062F, -0.025944274F, -0.018478476F, -0.011149953F, -0.005772376F,
     -0.0025833794F, -0.0010043529F, -0.00034032232F, -0.00010074583F, -2.6100746e-05F, -5.925725e-06F, -1.1801491e-06F,
     -2.0634295e-07F},
    {-0.0059326566F, -0.0048064524F, -0.0022862938F, 0.0004024261F, 0.0021409842F, 0.0026033698F, 0.0021634444F, 0.0014106946F,
     0.0007574606F, 0.0003426949F, 0.00013233953F, 4.397523e-05F, 1.26418445e-05F, 3.156131e-06F, 6.862161e-07F, 1.3021265e-07F},
    {0.00013314691F, 0.0004917126F, 0.0007099276F, 0.0005857576F, 0.00027073527F, -2.1798342e-05F, -0.00017215616F,
     -0.00018694239F, -0.00013449816F, -7.4852556e-05F, -3.3979417e-05F, -1.29042255e-05F, -4.158826e-06F, -1.1477413e-06F,
     -2.7290199e-07F, -5.6150373e-08F},
};
HWY_INLINE Real of_piece(int degree, Real i) {  // i: the piece added to 2^23
  const Floats d;
  const float* constants = piece_constants[degree];
  const IntVec bits = hn::BitCast(Ints(), i.v);
#if HWY_TARGET == HWY_AVX3
  return hn::TableLookupLanes(hn::LoadU(d, constants), hn::Indices512<float>{bits.raw});  // by the last four bits
#elif HWY_TARGET == HWY_AVX2
  const hn::Indices256<float> index{bits.raw};  // by the last three
  const Real low = hn::TableLookupLanes(hn::LoadU(d, constants), index),
             high = hn::TableLookupLanes(hn::LoadU(d, constants + 8), index);
  return select(i >= 8388616.0, high, low);
#else
  return hn::GatherIndex(d, constants, hn::And(bits, hn::Set(Ints(), 15)));
#endif
}
HWY_INLINE Real erf_of_pieces(Real x) {
  const Real t = min(abs(x) * 4.0, 15.49), i = t + 8388608.0;
  const Real w = t - (i - 8388608.0);
  Real q = of_piece(4, i);
  for (int degree = 3; degree >= 0; --degree) q = fma(w, q, of_piece(degree, i));
  return hn::CopySignToAbs(q.v, x.v);
}

// 0 and 1 as for gaussian_erf(), 2: of pieces.
template <int kind>
HWY_INLINE Real erf_of(Real x) {
  if constexpr (kind == 2) return erf_of_pieces(x);
  return gaussian_erf(kind, x);
}

template <int kind>
HWY_ATTR static void erf_over(const float* x, float* y, std::size_t n) {
  for (std::size_t i = 0; i < n; i += lanes) store(erf_of<kind>(load(x + i)), y + i);
}
static void erf_accurate(const float* x, float* y, std::size_t n) { erf_over<0>(x, y, n); }
static void erf_pieces(const float* x, float* y, std::size_t n) { erf_over<2>(x, y, n); }
static void erf_fast(const float* x, float* y, std::size_t n) { erf_over<1>(x, y, n); }

template <int kind>
HWY_ATTR static void lines_over(const LineRays& rays, std::span<const LineGaussian> gaussians, float* depth) {
  for (std::size_t i = 0; i < rays.n; i += lanes) {
    const Real dx = load(rays.x + i), dy = load(rays.y + i), dz = load(rays.z + i), length = load(rays.length + i);
    Real sum = 0.0;
    for (const LineGaussian& g : gaussians) {
      Real foot, h;
      perpendicular(dx, dy, dz, g.x, g.y, g.z, 0.0, foot, h);
      // gaussian_depth() with any of the three.
      const Real from = erf_of<kind>(-foot * g.inverse), to = erf_of<kind>((length - foot) * g.inverse);
      sum = fma(gaussian_between(gaussian_lateral(g.inverse, h), from, to), g.whole, sum);
    }
    store(sum, depth + i);
  }
}
static void lines_accurate(const LineRays& r, std::span<const LineGaussian> g, float* depth) { lines_over<0>(r, g, depth); }
static void lines_pieces(const LineRays& r, std::span<const LineGaussian> g, float* depth) { lines_over<2>(r, g, depth); }
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
HWY_EXPORT(erf_pieces);
HWY_EXPORT(lines_pieces);
HWY_EXPORT(lines_accurate);
HWY_EXPORT(lines_fast);
HWY_EXPORT(fma_limit);
HWY_EXPORT(sqrt_limit);

void add_ours(ErfCandidates& all) {
  for (const Simd simd : available_simd()) {
    const std::string target(name_of(simd));
    all.erf.push_back({"ours", target, entry(HWY_DISPATCH_TABLE(erf_accurate), simd)});
    all.erf.push_back({"ours, as printed", target, entry(HWY_DISPATCH_TABLE(erf_fast), simd)});
    all.erf.push_back({"16 pieces", target, entry(HWY_DISPATCH_TABLE(erf_pieces), simd)});
    all.lines.push_back({"erf of 16 pieces", target, entry(HWY_DISPATCH_TABLE(lines_pieces), simd)});
    all.lines.push_back({"ours", target, entry(HWY_DISPATCH_TABLE(lines_accurate), simd)});
    all.lines.push_back({"ours, erf as printed", target, entry(HWY_DISPATCH_TABLE(lines_fast), simd)});
    if (simd == Simd::scalar) continue;  // its std::fma is a call
    all.limits.push_back({"fma", target, entry(HWY_DISPATCH_TABLE(fma_limit), simd)});
    all.limits.push_back({"sqrt", target, entry(HWY_DISPATCH_TABLE(sqrt_limit), simd)});
  }
}

}  // namespace airlight
#endif
