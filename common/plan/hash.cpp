#include "common/plan/hash.h"

#include <cstring>

namespace airlight {

namespace {

// A multiply-and-fold step: each input bit reaches every bit of the state.
std::uint64_t mix(std::uint64_t state, std::uint64_t word) {
  __extension__ using Wide = unsigned __int128;
  const Wide product = static_cast<Wide>(state ^ word ^ 0xa0761d6478bd642fU) * ((word + 0xe7037ed1a0b428dbU) | 1U);
  return (state + 0x9e3779b97f4a7c15U) ^ static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
}

}  // namespace

void Hash::bytes(std::span<const std::byte> data) {
  std::uint64_t word = 0;
  while (data.size() >= 8) {
    std::memcpy(&word, data.data(), 8);
    state_ = mix(state_, word);
    data = data.subspan(8);
  }
  if (data.empty()) return;
  word = data.size() << 56U;  // a short tail differs from the same bytes followed by zeros
  std::memcpy(&word, data.data(), data.size());
  state_ = mix(state_, word);
}

}  // namespace airlight
