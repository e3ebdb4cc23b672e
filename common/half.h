// Floats of 16 bits (IEEE binary16) as volumes may be kept in: of numbers that are not negative. Integer arithmetic and exact
// sums, so that every machine has the same bits; gpu/dialect.glsl and gpu/pack_halves.glsl do the same.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace airlight {

// The nearest, of two the even one; 65504 for all above. x >= 0.
inline std::uint16_t half_of(float x) {
  const float held = std::min(x, 65504.0F);
  const auto bits = std::bit_cast<std::uint32_t>(held);
  const std::uint32_t normal = ((bits + 0xfffU + ((bits >> 13U) & 1U)) >> 13U) - 0x1c000U;
  // Below 2^-14 steps are of 2^-24, as those of a float above 1/2.
  const std::uint32_t tiny = std::bit_cast<std::uint32_t>(held + 0.5F) - 0x3f000000U;
  return static_cast<std::uint16_t>(bits < 0x38800000U ? tiny : normal);
}

// Exact, and no denormal.
inline float float_of(std::uint16_t half) {
  if (half < 0x400U) return static_cast<float>(half) * 0x1p-24F;
  return std::bit_cast<float>((static_cast<std::uint32_t>(half) << 13U) + 0x38000000U);
}

// [float] that so many halves take in a table, with room behind for a vector that is read across the last.
constexpr std::size_t floats_of_halves(std::size_t halves) { return (halves + 1) / 2 + 8; }

}  // namespace airlight
