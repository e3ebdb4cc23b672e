// Tiled rasteriser of shadow planes: all planes are set up and binned once, then each tile can be made on its own, on any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/algorithms/shadow_planes.h"
#include "common/plan/shadow_quads.h"
#include "cpu/held_images.h"
#include "cpu/parallel.h"
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

// Where rays cross planes in one tile, one light at a time. Memory of a worker: it grows to what the fullest tile needs.
struct Crossings {
  // In the order of the planes: 1/z, and pixel + tile_pixels * (change + 2^17).
  std::vector<float> k;
  std::vector<std::uint32_t> where;
  std::size_t count = 0;

  // By pixel, from begin[p] to begin[p + 1]; then sorted by distance.
  struct One {
    float k;
    std::int32_t change;
  };
  std::vector<One> sorted;
  std::vector<std::uint32_t> begin;

  // The lit parts [m] by pixel, from first_part[p] to first_part[p + 1].
  std::vector<float> from, to;
  std::vector<std::uint32_t> first_part;

  AlignedFloats rays;  // per pixel: length of the ray [m]; length over z; 1/z of its end
};

class ShadowRasteriser {
 public:
  ShadowRasteriser();
  ~ShadowRasteriser();

  // `volumes` must stay valid until the last run_tile().
  void prepare(const ShadowPlanes&, std::span<const std::byte> volumes, Simd, Workers&);

  // Safe from many threads at once, each with its own worker.
  void run_tile(const ShadowPlanes&, const TileView&, int worker) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace airlight
