// What the splats of a frame send toward the camera, made once for all tiles.
#pragma once

#include <span>
#include <vector>

#include "common/algorithms/particle_splats.h"
#include "cpu/parallel.h"
#include "cpu/targets.h"
#include "cpu/tile.h"

namespace airlight {

// A splat of the kernel: all that it needs of one, behind each other.
enum SeenField : int { seen_center = 0, seen_inverse_support = 3, seen_peak = 4, seen_radiance = 5, seen_fields = 8 };

// seen_fields floats a splat, in the order of `splats`. The spans are the buffers of the algorithm's fields.
void see_splats(const ParticleSplats&, std::span<const float> splats, std::span<const float> particle_sources,
                std::span<const std::int32_t> lines, Workers&, Simd, std::vector<float>& seen);

void run_tile(const ParticleSplats&, const TileView&, std::span<const float> seen, Simd);

}  // namespace airlight
