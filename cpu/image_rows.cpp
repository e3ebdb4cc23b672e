#include "cpu/image_rows.h"

#include <algorithm>
#include <functional>

namespace airlight {

void take_rows(const HeldImage& image, Rows wanted, std::span<float> rows, Workers& workers) {
  if (image.image().layers > 1) return image.to_rows(wanted, rows);
  const Rows all = within(wanted, image.image().extent.height);
  const int first = all.first / tile_side, end = (all.end + tile_side - 1) / tile_side;  // rows of tiles
  const std::size_t floats = rows.size() / static_cast<std::size_t>(std::max(all.count(), 1));
  const auto take = [&](int i, int) {
    const Rows some{std::max((first + i) * tile_side, all.first), std::min((first + i + 1) * tile_side, all.end)};
    image.to_rows(some, rows.subspan(floats * static_cast<std::size_t>(some.first - all.first),
                                     floats * static_cast<std::size_t>(some.count())));
  };
  workers.each(end - first, std::cref(take));  // not copied, which would allocate
}

}  // namespace airlight
