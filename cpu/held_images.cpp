#include "cpu/held_images.h"

#include <algorithm>
#include <new>
#include <stdexcept>

namespace airlight {

namespace {
constexpr std::align_val_t cache_line{64};
}

void AlignedFloats::Free::operator()(float* p) const { ::operator delete[](p, cache_line); }

float* AlignedFloats::resize(std::size_t n) {
  if (n > size_) {
    data_.reset();
    size_ = 0;
    data_.reset(new (cache_line) float[n]());
    size_ = n;
  }
  return data_.get();
}

void HeldImage::reset(const Image& image, Rows rows) {
  image_ = image;
  tiling_ = {image.extent, rows};
  key = 0;
  floats_per_tile_ = static_cast<std::size_t>(image.layers * channels(image.format)) * tile_pixels;
  values_.resize(floats_per_tile_ * static_cast<std::size_t>(tiling_.count()));
}

// copy(in the tile, in the rows, pixels): each of these rows of each tile of each layer. In the rows a pixel's channels lie side
// by side, in the tile they are tile_pixels apart.
template <class Copy>
void HeldImage::each_row_piece(Rows wanted, Copy&& copy) const {
  const auto planes = static_cast<std::size_t>(channels(image_.format));
  const auto width = static_cast<std::size_t>(image_.extent.width);
  const auto layer_pixels = width * static_cast<std::size_t>(wanted.count());
  for (int t = 0; t < tiling_.count(); ++t) {
    const Tile at = tiling_.tile(t);
    const int columns = std::min(tile_side, image_.extent.width - at.x);
    const int first = std::max(wanted.first - at.y, 0), end = std::min(tile_side, wanted.end - at.y);
    float* pixels = tile(t);
    for (int layer = 0; layer < image_.layers; ++layer, pixels += planes * tile_pixels) {
      for (int y = first; y < end; ++y) {
        const std::size_t pixel = static_cast<std::size_t>(layer) * layer_pixels +
                                  static_cast<std::size_t>(at.y + y - wanted.first) * width + static_cast<std::size_t>(at.x);
        copy(pixels + static_cast<std::ptrdiff_t>(y) * tile_side, pixel * planes, columns);
      }
    }
  }
}

void HeldImage::from_rows(std::span<const float> rows) {
  if (rows.size() != image_.floats()) throw std::logic_error("image upload: wrong number of floats");
  const int planes = channels(image_.format);
  each_row_piece({0, image_.extent.height}, [&](float* in_tile, std::size_t first, int pixels) {
    for (int x = 0; x < pixels; ++x) {
      for (int c = 0; c < planes; ++c) in_tile[c * tile_pixels + x] = rows[first + static_cast<std::size_t>(x * planes + c)];
    }
  });
}

void HeldImage::copy_row(int x, int y, int n, int channel, int layer, float* to) const {
  const int last = image_.extent.width - 1, row = std::clamp(y, rows().first, rows().end - 1);
  const std::ptrdiff_t in_tile = (layer * channels(image_.format) + channel) * tile_pixels + row % tile_side * tile_side;
  const float* tiles = tile((row / tile_side - tiling_.first_row()) * tiling_.columns()) + in_tile;
  const auto at = [&](int column) {
    return tiles + column / tile_side * static_cast<std::ptrdiff_t>(floats_per_tile_) + column % tile_side;
  };
  for (int done = 0; done < n;) {
    const int column = x + done;
    if (column < 0 || column > last) {
      to[done++] = *at(std::clamp(column, 0, last));
      continue;
    }
    const int run = std::min({n - done, last + 1 - column, tile_side - column % tile_side});
    std::copy_n(at(column), run, to + done);
    done += run;
  }
}

void HeldImage::to_rows(Rows asked, std::span<float> rows) const {
  const Rows wanted = within(asked, image_.extent.height), held = this->rows();
  if (wanted.first < held.first || wanted.end > held.end) throw std::logic_error("image download: rows that are not held");
  Image part = image_;
  part.extent.height = wanted.count();
  if (rows.size() != part.floats()) throw std::logic_error("image download: wrong number of floats");
  const int planes = channels(image_.format);
  each_row_piece(wanted, [&](const float* in_tile, std::size_t first, int pixels) {
    float* to = rows.data() + first;
    if (planes == 1) {
      std::copy_n(in_tile, pixels, to);
      return;
    }
    const float *red = in_tile, *green = red + tile_pixels, *blue = green + tile_pixels;
    for (int x = 0; x < pixels; ++x) to[3 * x] = red[x], to[3 * x + 1] = green[x], to[3 * x + 2] = blue[x];
  });
}

}  // namespace airlight
