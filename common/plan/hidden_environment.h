// What surfaces hide of an environment, as HiddenEnvironment takes it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "common/plan/environment.h"
#include "common/plan/surface_transfer.h"
#include "common/scene/scene.h"

namespace airlight {

// The table of HiddenEnvironment. Lambert's lobe is met by a dot product; others by the triple product of what is hidden, the
// environment, and the lobe (Zhou et al. 2007, eq. 20), of which all but the lobe's direction is done here; tabulated
// reflectances, whose lobe changes with the viewing angle, by the same without the lobe.
std::vector<float> hidden_environment_table(const Scene&, const SurfaceTransfer&);

// How many floats that is, and how many vertices and triangles the geometry below; without a transfer, which takes long to make:
// at most, where no more than two triangles meet in an edge.
struct HiddenSizes {
  std::size_t table = 0, vertices = 0, triangles = 0;
};
HiddenSizes hidden_sizes(const Scene&, const SurfaceTransfer*);

// The coefficients of hidden(direction) times an environment, both of order 6, cut off again at that order.
class HarmonicProduct {
 public:
  explicit HarmonicProduct(const EnvironmentHarmonics&);
  // `hidden`: 36 coefficients. Gives 36 a channel.
  void times(const float* hidden, std::span<double, 108> product) const;

 private:
  std::vector<double> matrix_;  // [channel][product][hidden]
};

// The scene's geometry with the edges cut that the transfer cuts, laid out as geometry_of() does.
std::vector<std::byte> cut_positions(const Scene&, const SurfaceTransfer&);
std::vector<std::byte> cut_normals(const Scene&, const SurfaceTransfer&);
std::vector<std::byte> cut_triangles(const Scene&, const SurfaceTransfer&);

}  // namespace airlight
