// Tables of which a part is kept in 16 bits.
#pragma once

#include <cstddef>
#include <vector>

#include "common/half.h"
#include "cpu/parallel.h"

namespace airlight {

// A table of floats becomes one at `to`: the first `head` as they are, then `count` times `scale` as halves, then what is left.
inline void pack_halves(const std::vector<float>& table, std::size_t head, std::size_t count, float scale, float* to,
                        Workers& workers) {
  std::copy_n(table.data(), head, to);
  const float* from = table.data() + head;
  auto* halves = reinterpret_cast<std::uint16_t*>(to + head);
  const std::size_t room = 2 * floats_of_halves(count);
  constexpr std::size_t part = 1 << 16;
  workers.each(static_cast<int>((room + part - 1) / part), [&](int n, int) {
    const std::size_t first = part * static_cast<std::size_t>(n), end = std::min(first + part, room);
    const std::size_t last = std::max(std::min(end, count), first);
    for (std::size_t i = first; i < last; ++i) halves[i] = half_of(from[i] * scale);
    std::fill(halves + last, halves + end, std::uint16_t{0});
  });
  std::copy(from + count, table.data() + table.size(), to + head + floats_of_halves(count));
}

}  // namespace airlight
