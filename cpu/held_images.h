// What the CPU backend holds between and during runs: whole images, tile by tile, and buffers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "common/image.h"
#include "cpu/tile.h"

namespace airlight {

// Floats on a 64-byte boundary (a cache line, and the widest vector).
class AlignedFloats {
 public:
  // Grows only; the content is lost when it does.
  float* resize(std::size_t n);
  float* data() const { return data_.get(); }
  std::size_t size() const { return size_; }

 private:
  struct Free {
    void operator()(float* p) const;
  };
  std::unique_ptr<float[], Free> data_;
  std::size_t size_ = 0;
};

// One image, or the tiles of it that have some rows in them: [tile][layer][channel][tile_pixels].
class HeldImage {
 public:
  void reset(const Image&, Rows = {});
  // By its number among those that are held.
  float* tile(int index) const { return values_.data() + static_cast<std::size_t>(index) * floats_per_tile_; }
  const Image& image() const { return image_; }
  // How many of the tiles that are held stand in rows above the first of these.
  int tiles_above(const Tiling& tiles) const { return (tiles.first_row() - tiling_.first_row()) * tiling_.columns(); }
  Rows rows() const { return within(tiling_.made, image_.extent.height); }
  std::size_t bytes() const { return values_.size() * sizeof(float); }
  // Of one layer and channel the `n` pixels from (x, y) on; beyond the border, or where nothing is held, those that are next to
  // it are repeated.
  void copy_row(int x, int y, int n, int channel, int layer, float* to) const;
  // One pixel, which must lie in the rows that are held.
  float at(int x, int y, int channel = 0, int layer = 0) const {
    const int index = (y / tile_side - tiling_.first_row()) * tiling_.columns() + x / tile_side;
    return tile(index)[(layer * channels(image_.format) + channel) * tile_pixels + y % tile_side * tile_side + x % tile_side];
  }
  void from_rows(std::span<const float>);
  void to_rows(Rows, std::span<float>) const;

  std::uint64_t key = 0;  // of its content; 0: none

 private:
  template <class Copy>
  void each_row_piece(Rows, Copy&&) const;

  Image image_;
  Tiling tiling_;
  std::size_t floats_per_tile_ = 0;
  AlignedFloats values_;
};

struct HeldBuffer {
  std::vector<std::byte> bytes;
  std::uint64_t key = 0;
};

// What a kernel that makes buffers sees of them.
class BufferView {
 public:
  BufferView(std::map<Handle, HeldBuffer>& held, StepCounts& step_counts) : counts(step_counts), held_(held) {}
  const float* floats(const Buffer& b) const { return made(b); }
  const std::int32_t* integers(const Buffer& b) const { return reinterpret_cast<const std::int32_t*>(made(b)); }
  float* made(const Buffer& b) const { return b ? reinterpret_cast<float*>(held_.at(b).bytes.data()) : nullptr; }

  StepCounts& counts;  // to be told by one thread

 private:
  std::map<Handle, HeldBuffer>& held_;
};

}  // namespace airlight
