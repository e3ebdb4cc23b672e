#include "cpu/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/targets.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

// Which target this code really was compiled for.
static Simd target_that_runs() {
#if HWY_TARGET == HWY_AVX3
  return Simd::avx512;
#elif HWY_TARGET == HWY_AVX2
  return Simd::avx2;
#elif HWY_TARGET == HWY_NEON
  return Simd::neon;
#else
  static_assert(HWY_TARGET == HWY_SCALAR);
  return Simd::scalar;
#endif
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(target_that_runs);

Simd target_that_runs(Simd asked) { return entry(HWY_DISPATCH_TABLE(target_that_runs), asked)(); }

std::vector<Simd> available_simd() {
  std::vector<Simd> found{Simd::scalar};
  const std::int64_t usable = hwy::SupportedTargets() & HWY_TARGETS;
  if (usable & HWY_NEON) found.push_back(Simd::neon);
  if (usable & HWY_AVX2) found.push_back(Simd::avx2);
  if (usable & HWY_AVX3) found.push_back(Simd::avx512);
  return found;
}

std::string highway_version() {
  return std::to_string(HWY_MAJOR) + "." + std::to_string(HWY_MINOR) + "." + std::to_string(HWY_PATCH);
}

std::string_view name_of(Simd simd) {
  switch (simd) {
    case Simd::scalar:
      return "scalar";
    case Simd::avx2:
      return "AVX2";
    case Simd::avx512:
      return "AVX-512";
    case Simd::neon:
      break;
  }
  return "NEON";
}

}  // namespace airlight
#endif
