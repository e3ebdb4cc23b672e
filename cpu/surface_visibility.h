// Tiled triangle rasteriser: all triangles are set up and binned once, then each tile can be made on its own, on any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "common/algorithms/surface_visibility.h"
#include "cpu/parallel.h"
#include "cpu/targets.h"
#include "cpu/tile.h"

namespace airlight {

class Rasteriser {
 public:
  Rasteriser();
  ~Rasteriser();

  // `positions`, `normals`: float[3] a vertex; `triangles`: uint32[4] a triangle. They must stay valid until the last run_tile().
  // Tiles are those of these rows. Returns how many triangles there are, and how many of them are in no tile.
  StepCounts prepare(const SurfaceVisibility&, Rows, std::span<const float> positions, std::span<const float> normals,
                     std::span<const std::uint32_t> triangles, Simd, Workers&);

  // Each pointer: tile_pixels floats; `corners`: three of them, or null. Safe from many threads at once. Returns whether a
  // triangle is in the tile.
  bool run_tile(Tile, float* distance, float* normal_x, float* normal_y, float* normal_z, float* material,
                float* const* corners) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace airlight
