// Which SIMD targets are built, chosen before Highway is first included, and how one of them is asked for. There is no
// global choice: every call names its target, so two backends with different targets can run at once.
#pragma once

// Scalar is Highway's one-lane target in every compiler; the targets in between are left out.
#define HWY_COMPILE_ALL_ATTAINABLE
#define HWY_BROKEN_EMU128 1
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)

#include <hwy/targets.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace airlight {

enum class Simd { scalar, avx2, avx512, neon };

// Of this machine and build, best last; scalar is always there.
std::vector<Simd> available_simd();
std::string_view name_of(Simd);

// "1.0.3"
std::string highway_version();

// The target of the code that a call for `asked` ends in, as told by that code.
Simd target_that_runs(Simd asked);

// Entry of a HWY_EXPORT table (HWY_DISPATCH_TABLE(f)) for an available target.
template <class Function, std::size_t n>
Function* entry(Function* const (&table)[n], Simd simd) {
  if constexpr (n == 1) return table[0];
  std::int64_t target = 0;
#if HWY_ARCH_X86
  if (simd == Simd::avx2) target = HWY_AVX2;
  if (simd == Simd::avx512) target = HWY_AVX3;
#elif HWY_ARCH_ARM
  if (simd == Simd::neon) target = HWY_NEON;
#endif
  if (target == 0) return table[n - 1];  // scalar, the fallback
  int bit = 0;
  while (((target >> bit) & 1) == 0) ++bit;
  return table[static_cast<std::size_t>(bit - (HWY_HIGHEST_TARGET_BIT + 1 - HWY_MAX_DYNAMIC_TARGETS) + 1)];
}

}  // namespace airlight
