// Random numbers that are functions of counters: any thread may compute any of them, in any order.
#pragma once

#include <array>
#include <cstdint>

namespace airlight {

// Philox4x32 with ten rounds: Salmon, Moraes, Dror, Shaw: Parallel random numbers: as easy as 1, 2, 3, 2011, section 3.
inline std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = 0xD2511F53ULL * counter[0], b = 0xCD9E8D57ULL * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key[0] += 0x9E3779B9U, key[1] += 0xBB67AE85U;
  }
  return counter;
}

// The numbers of one path, each uniform in 0 <= x < 1 in steps of 2^-53.
class Random {
 public:
  using Key = std::array<std::uint32_t, 2>;  // of all paths of a pixel

  Random(const Key& key, std::uint64_t path) : key_(key), path_(path) {}

  double next() {
    if (used_ == 2) {
      block_ = philox({number_++, static_cast<std::uint32_t>(path_), static_cast<std::uint32_t>(path_ >> 32), 0}, key_);
      used_ = 0;
    }
    const std::uint64_t low = block_[2 * used_], high = block_[2 * used_ + 1];
    ++used_;
    return static_cast<double>((high << 32 | low) >> 11) * 0x1p-53;
  }

 private:
  Key key_;
  std::uint64_t path_;
  std::array<std::uint32_t, 4> block_{};
  std::uint32_t number_ = 0;
  std::size_t used_ = 2;
};

}  // namespace airlight
