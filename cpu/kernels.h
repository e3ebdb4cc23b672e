// Entry points of the kernels, on the asked SIMD target: of the per-pixel ones for a tile. Each stands in the file of its
// algorithm's name.
#pragma once

#include <span>

#include "common/algorithms/algorithm.h"
#include "cpu/held_images.h"
#include "cpu/parallel.h"
#include "cpu/shadow_parts.h"
#include "cpu/targets.h"
#include "cpu/tile.h"

namespace airlight {

void run_tile(const ViewTransmittance&, const TileView&, Simd);
void run_tile(const SurfaceAirlight&, const TileView&, Simd);
void run_tile(const MeanDepth&, const TileView&, Simd);
void run_tile(const EnvironmentLight&, const TileView&, Simd);
void run_tile(const SurfaceShading&, const TileView&, Simd);
void run_tile(const HomogeneousAirlight&, const TileView&, Simd);
// `lit`: the lit parts of each light, or nothing where every light reaches everything.
void run_tile(const RayMarch&, const TileView&, Simd, std::span<const LitParts> lit);
void run_tile(const GaussianAirlight&, const TileView&, Simd, std::span<const LitParts> lit);
void run_tile(const ProjectedGaussians&, const TileView&, Simd);
void run_tile(const LightMarch&, const TileView&, Simd);
void run_tile(const Subsample&, const TileView&, Simd);
void run_tile(const DepthAwareUpsample&, const TileView&, Simd);
void run_tile(const FillAirlight&, const TileView&, Simd);
void run_tile(const EnvironmentAirlight&, const TileView&, Simd);
void run_tile(const HiddenEnvironment&, const TileView&, Simd);
void run_tile(const EnvironmentIndirect&, const TileView&, Simd);
void run_tile(const Compose&, const TileView&, Simd);
// Those that make buffers.
void run_volume(const MeanDepthLattice&, const BufferView&, Workers&, Simd);
void run_volume(const DensityInjection&, const BufferView&, Workers&, Simd);
void run_volume(const OpticalDepthPropagation&, const BufferView&, Workers&, Simd);
void run_volume(const VisibilityNetwork&, const BufferView&, Workers&, Simd);
void run_volume(const ParticleLight&, const BufferView&, Workers&, Simd);
void run_volume(const NetworkIteration&, const BufferView&, Workers&, Simd);
void run_volume(const SourceFunction&, const BufferView&, Workers&, Simd);

}  // namespace airlight
