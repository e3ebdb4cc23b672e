// The screen is cut into square tiles, and every image is held tile by tile: a tile's pixels lie together (row by row, 64 x 64
// also at the border, where the pixels outside the image are computed and never read), one plane a channel.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/image.h"
#include "common/rows.h"

namespace airlight {

constexpr int tile_side = 64;
constexpr int tile_pixels = tile_side * tile_side;  // 4096: what stays in the first and second cache

struct Tile {
  int index = 0;     // among those that are made of the image
  int x = 0, y = 0;  // pixel of its upper left corner, in the whole image
};

// Those tiles of an image that have the rows in them. Their corners stand at multiples of tile_side in the whole image, so that a
// pixel has the same place in its tile whatever is made of the image.
struct Tiling {
  Extent extent;
  Rows made = {};
  int columns() const { return (extent.width + tile_side - 1) / tile_side; }
  int first_row() const { return within(made, extent.height).first / tile_side; }
  int rows() const { return (within(made, extent.height).end + tile_side - 1) / tile_side - first_row(); }
  int count() const { return columns() * std::max(rows(), 0); }
  Tile tile(int index) const { return {index, index % columns() * tile_side, (first_row() + index / columns()) * tile_side}; }
};

// Whether a ray of a square in a tile has a length. Of pixels that are known without it none has.
inline bool any_ray(const float* distance, int x = 0, int y = 0, int side = tile_side) {
  for (int row = y; row < y + side; ++row) {
    const float* first = distance + row * tile_side + x;
    if (std::any_of(first, first + side, [](float value) { return value > 0; })) return true;
  }
  return false;
}

class HeldImage;

// What a step passed over, by one worker: pixels of the image, and what else it works through (common/plan/step_skips.h).
struct StepCounts {
  std::uint64_t skipped = 0;
  std::uint64_t parts = 0, skipped_parts = 0;

  void add(const StepCounts& more) { skipped += more.skipped, parts += more.parts, skipped_parts += more.skipped_parts; }
};

// What a kernel sees of one tile: its place, and its pixels of each image.
struct TileView {
  Tile tile;
  Extent extent;  // of the image
  StepCounts* counts = nullptr;
  std::vector<float*> images;                       // by handle id; each [layer][channel][tile_pixels]
  std::vector<const HeldImage*> others;             // by handle id: images of another extent, whole
  std::vector<std::span<const std::byte>> buffers;  // by handle id

  float* plane(const Image& image, int channel = 0, int layer = 0) const {
    if (!image) return nullptr;
    return images[image.id] + static_cast<std::ptrdiff_t>(layer * channels(image.format) + channel) * tile_pixels;
  }
  // How many of the n pixels from number i on, of one row of the tile, are in the image.
  int in_image(int i, int n) const {
    return tile.y + i / tile_side < extent.height ? std::clamp(extent.width - tile.x - i % tile_side, 0, n) : 0;
  }
  // And of a square of the tile.
  int in_image(int x, int y, int side) const { return in_image(x, side) * std::clamp(extent.height - tile.y - y, 0, side); }
  void skip(int pixels) const { counts->skipped += static_cast<std::uint64_t>(pixels); }
  const float* floats(const Buffer& buffer) const {
    return buffer ? reinterpret_cast<const float*>(buffers[buffer.id].data()) : nullptr;
  }
};

}  // namespace airlight
