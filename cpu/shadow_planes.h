// Tiled rasteriser of shadow planes: all planes are set up and binned once, then each tile can be made on its own, on any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/algorithms/shadow_planes.h"
#include "common/plan/shadow_quads.h"
#include "cpu/parallel.h"
#include "cpu/shadow_parts.h"
#include "cpu/targets.h"
#include "cpu/tile.h"

namespace airlight {

// The planes of one light.
struct LightVolumes {
  std::vector<ShadowQuads> chunks;  // in order of the edges, however many threads there were
  std::size_t used = 0;
  std::int64_t covering = 0;

  std::span<const ShadowQuads> all() const { return {chunks.data(), used}; }
};

class ShadowRasteriser {
 public:
  ShadowRasteriser();
  ~ShadowRasteriser();

  // `volumes` must stay valid until the last tile. Tiles are those of these rows.
  void prepare(const View&, Rows, std::size_t lights, std::span<const std::byte> volumes, Simd, Workers&);

  // Both are safe from many threads at once, each with its own worker.
  void run_tile(const ShadowPlanes&, const TileView&, int worker) const;
  // The lit parts of each light over the tile; none where every light reaches everything. Valid until the worker's next call.
  std::span<const LitParts> lit_parts(const View&, const Image& distance, float sky_distance, const TileView&, int worker) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace airlight
