// What the pixels of one tile need of the samples around them, laid out so that every pixel finds it in its own column.
#pragma once

#include <cstddef>

#include "common/algorithms/depth_aware_upsample.h"
#include "cpu/held_images.h"
#include "cpu/tile.h"

namespace airlight {

class SampleWindow {
 public:
  // In a row of samples, for each column of pixels: the sample at its left, the one at its right, their bend and its size.
  struct Row {
    const float *left, *right, *bend, *size;
  };

  SampleWindow(const DepthAwareUpsample&, const TileView&);

  Extent extent;        // of all samples
  int first_row, rows;  // of the window, in samples
  // Plane 0 is 1/distance, 1 .. 3 are channels of airlight, 4 is the transmittance; then come three channels a light.
  static constexpr int transmittance_plane = 4, first_light_plane = 5;
  Row row(int plane, int sample_row) const {
    const float* left = values_.data() + (static_cast<std::ptrdiff_t>(plane) * rows + sample_row - first_row) * floats_a_row;
    return {left, left + tile_side, left + 2 * tile_side, left + 3 * tile_side};
  }

 private:
  static constexpr std::ptrdiff_t floats_a_row = 4 * tile_side;
  AlignedFloats values_;
};

}  // namespace airlight
