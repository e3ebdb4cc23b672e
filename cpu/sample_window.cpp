#include "cpu/sample_window.h"

#include <algorithm>

#include "common/formulas/float.h"

namespace airlight {

SampleWindow::SampleWindow(const DepthAwareUpsample& a, const TileView& view)
    : extent(a.sampled_distance.extent), first_row(view.tile.y / a.stride - rows_before) {
  constexpr int columns = tile_side / 2 + 4;
  const int first_column = view.tile.x / a.stride - 2, last_cell = std::max(extent.width - 2, 0);
  int left_of[tile_side];  // in the window's row
  for (int x = 0; x < tile_side; ++x) left_of[x] = std::min((view.tile.x + x) / a.stride, last_cell) - first_column;

  const int layers = a.per_light ? a.per_light.layers : 0;
  float* to = values_.resize(static_cast<std::size_t>(first_light_plane + 3 * layers) * rows * floats_a_row);
  const auto fill = [&](const Image& image, int channel, int layer, bool inverse) {
    float samples[columns], bends[columns] = {}, sizes[columns] = {};
    for (int row = 0; row < rows; ++row, to += floats_a_row) {
      view.others[image.id]->copy_row(first_column, first_row + row, columns, channel, layer, samples);
      for (int x = 1; x + 2 < columns && !inverse; ++x) {
        const bool has_left = first_column + x > 0, has_right = first_column + x < last_cell;
        bends[x] = f32::bend_between(samples[x - 1], samples[x], samples[x + 1], samples[x + 2], has_left, has_right).v;
        sizes[x] = f32::bend_size(samples[x - 1], samples[x], samples[x + 1], samples[x + 2], has_left, has_right).v;
      }
      for (float& s : samples) s = inverse ? 1 / s : s;
      for (int x = 0; x < tile_side; ++x) to[x] = samples[left_of[x]];
      for (int x = 0; x < tile_side; ++x) to[tile_side + x] = samples[left_of[x] + 1];
      for (int x = 0; x < tile_side; ++x) to[2 * tile_side + x] = bends[left_of[x]];
      for (int x = 0; x < tile_side; ++x) to[3 * tile_side + x] = sizes[left_of[x]];
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
