#include "cpu/sample_window.h"

#include <algorithm>

#include "common/formulas/float.h"

namespace airlight {

namespace {

// To each of `stride` columns of pixels what belongs to the cell of samples that it is in, for all cells of a tile. There is none
// behind number `last`.
template <int stride>
void spread(const float* of_cells, int last, float* of_pixels) {
  for (int cell = 0; cell < tile_side / stride; ++cell)
    for (int k = 0; k < stride; ++k) of_pixels[cell * stride + k] = of_cells[std::min(cell, last)];
}

}  // namespace

SampleWindow::SampleWindow(const DepthAwareUpsample& a, const TileView& view)
    : extent(a.sampled_distance.extent), first_row(view.tile.y / a.stride - 2), rows(tile_side / a.stride + 4) {
  constexpr int most_columns = tile_side / 2 + 4;
  const int columns = tile_side / a.stride + 4, first_column = view.tile.x / a.stride - 2;
  const int last = std::max(extent.width - 2, 0) - first_column;  // cell, in the window's row
  const auto spread = a.stride == 2 ? airlight::spread<2> : airlight::spread<4>;

  const int layers = a.per_light ? a.per_light.layers : 0;
  float* to = values_.resize(static_cast<std::size_t>((first_light_plane + 3 * layers) * rows) * floats_a_row);
  const auto fill = [&](const Image& image, int channel, int layer, bool inverse) {
    float samples[most_columns], bends[most_columns] = {}, sizes[most_columns] = {};
    const auto bend = [&](int x, bool has_left = true, bool has_right = true) {
      bends[x] = f32::bend_between(samples[x - 1], samples[x], samples[x + 1], samples[x + 2], has_left, has_right).v;
      sizes[x] = f32::bend_size(samples[x - 1], samples[x], samples[x + 1], samples[x + 2], has_left, has_right).v;
    };
    for (int row = 0; row < rows; ++row, to += floats_a_row) {
      view.others[image.id]->copy_row(first_column, first_row + row, columns, channel, layer, samples);
      if (inverse) {
        for (int x = 0; x < columns; ++x) samples[x] = 1 / samples[x];
      } else {
        for (int x = 1; x + 2 < columns; ++x) bend(x);
        if (first_column < 0) bend(2, false);
        if (last + 2 < columns) bend(last, first_column + last > 0, false);
      }
      spread(samples + 2, last - 2, to);
      spread(samples + 3, last - 2, to + tile_side);
      spread(bends + 2, last - 2, to + 2 * tile_side);
      spread(sizes + 2, last - 2, to + 3 * tile_side);
    }
  };
  fill(a.sampled_distance, 0, 0, true);
  for (int c = 0; c < 3; ++c) fill(a.sampled_airlight, c, 0, false);
  fill(a.sampled_transmittance, 0, 0, false);
  for (int k = 0; k < layers; ++k) {
    for (int c = 0; c < 3; ++c) fill(a.sampled_per_light, c, k, false);
  }
}

}  // namespace airlight
