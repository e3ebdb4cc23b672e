// Numbers as binary files store them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace airlight {

enum class RawType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, single, twice };

inline std::size_t bytes_of(RawType type) {
  constexpr std::array<std::size_t, 10> sizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

template <class T>
double raw_number_of(const char* from, bool swap) {
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), from, sizeof(T));
  if (swap) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<T>(raw));
}

// The number that begins at `from`; `swap`: its bytes are in the other order than this machine's.
inline double raw_number(const char* from, RawType type, bool swap) {
  switch (type) {
    case RawType::int8:
      return raw_number_of<std::int8_t>(from, swap);
    case RawType::uint8:
      return raw_number_of<std::uint8_t>(from, swap);
    case RawType::int16:
      return raw_number_of<std::int16_t>(from, swap);
    case RawType::uint16:
      return raw_number_of<std::uint16_t>(from, swap);
    case RawType::int32:
      return raw_number_of<std::int32_t>(from, swap);
    case RawType::uint32:
      return raw_number_of<std::uint32_t>(from, swap);
    case RawType::int64:
      return raw_number_of<std::int64_t>(from, swap);
    case RawType::uint64:
      return raw_number_of<std::uint64_t>(from, swap);
    case RawType::single:
      return raw_number_of<float>(from, swap);
    default:
      return raw_number_of<double>(from, swap);
  }
}

}  // namespace airlight
