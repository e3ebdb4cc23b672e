// SHA-256 (FIPS 180-4), for names of content that people compare: scene hashes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace airlight {

class Sha256 {
 public:
  void add(std::span<const std::byte>);
  void add(std::string_view text) { add(std::as_bytes(std::span(text))); }

  // 64 hexadecimal digits of everything added so far; the object can go on.
  std::string hex() const;

 private:
  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::byte, 64> block_{};  // what does not fill a block yet
  std::uint64_t size_ = 0;             // [byte] in all
};

}  // namespace airlight
