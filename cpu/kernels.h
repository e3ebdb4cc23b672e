// Entry points of the per-pixel kernels: one tile, on the asked SIMD target. Each stands in the file of its algorithm's name.
#pragma once

#include "common/algorithms/algorithm.h"
#include "cpu/targets.h"
#include "cpu/tile.h"

namespace airlight {

void run_tile(const ViewTransmittance&, const TileView&, Simd);
void run_tile(const SurfaceAirlight&, const TileView&, Simd);
void run_tile(const SurfaceShading&, const TileView&, Simd);
void run_tile(const HomogeneousAirlight&, const TileView&, Simd);
void run_tile(const RayMarch&, const TileView&, Simd);
void run_tile(const GaussianAirlight&, const TileView&, Simd);
void run_tile(const LightMarch&, const TileView&, Simd);
void run_tile(const Compose&, const TileView&, Simd);

}  // namespace airlight
