// Copies of single floats: no vector instruction would help.
#include <algorithm>

#include "cpu/held_images.h"
#include "cpu/kernels.h"

namespace airlight {

void run_tile(const Subsample& a, const TileView& view, Simd) {
  const HeldImage& whole = *view.others[a.whole.id];
  float* part = view.plane(a.part);
  const Extent last{a.whole.extent.width - 1, a.whole.extent.height - 1};
  for (int y = 0; y < tile_side; ++y) {
    for (int x = 0; x < tile_side; ++x) {  // those outside are never read, but they are numbers
      part[y * tile_side + x] =
          whole.at(std::min(a.stride * (view.tile.x + x), last.width), std::min(a.stride * (view.tile.y + y), last.height));
    }
  }
}

}  // namespace airlight
