// What surfaces hide of the sphere of directions from each other, vertex by vertex: made once for a scene's geometry, whatever
// the light (precomputed radiance transfer: Sloan et al. 2002). common/transfer makes it; plans only know what it looks like.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "common/scene/scene.h"

namespace airlight {

struct SurfaceTransfer {
  static constexpr std::size_t record_floats = 72;
  static constexpr std::size_t most_cuts = 100000;  // of edges; in each two triangles meet, with vertices of their own or not
  static constexpr std::uint32_t nothing = 0xffffffffU, everything = 0xfffffffeU;  // is hidden: no record

  // Long edges are cut where what is hidden changes along them. Each pair: two vertices, midway between which the next vertex
  // stands after those of all surfaces in their order; its normal is their normals' mean.
  std::vector<glm::uvec2> midpoints;
  // Three vertices and the surface; empty where nothing is cut.
  std::vector<glm::uvec4> triangles;
  // For each vertex seen from the front (the side of its normal), then for each from the back: the number of its record.
  std::vector<std::uint32_t> record;
  // Harmonics of order 6, axes as in common/plan/environment.h: of what is hidden above the horizon of that side times Lambert's
  // lobe about its normal, cos / pi; then of 1 where that is hidden.
  std::vector<float> records;

  std::size_t vertices() const { return record.size() / 2; }
};

// Gives the transfer of a scene's surfaces. Held by whoever renders.
class TransferSource {
 public:
  virtual ~TransferSource() = default;
  // From so many rays a side of a vertex. The same object again while the surfaces are the same.
  virtual std::shared_ptr<const SurfaceTransfer> transfer(const Scene&, int rays) = 0;
};

// Names all that it depends on: the surfaces' meshes, places, whether they cast shadows.
std::uint64_t transfer_key(const Scene&, int rays);

}  // namespace airlight
