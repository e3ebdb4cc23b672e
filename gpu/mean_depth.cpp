#include <glm/vec3.hpp>
#include <vector>

#include "gpu/gaussian_mean_depth.h"

namespace airlight {

void run(const MeanDepth& a, StepRunner& r, const Progress& progress) {
  Program& program = r.compute("gpu/mean_depth.glsl", {a.lattices.empty() ? "" : "WITH_LATTICES"});
  r.read(0, a.distance);
  r.read(1, a.material);
  r.write(0, a.mean_depth);
  r.view(a.view);
  if (a.lattices.empty()) {
    bind_mean_depth(r, a.gaussians);
    program.set("gaussian_count", static_cast<int>(a.gaussians.size()));
  } else {
    struct Lattice {  // as gpu/mean_depth.glsl reads it
      glm::vec3 corner;
      float scale;
      glm::ivec3 nodes;
      std::int32_t first;
    };
    std::vector<Lattice> lattices;
    for (const DepthLattice& l : a.lattices) lattices.push_back({l.corner, 1 / l.spacing, l.nodes, l.first});
    r.storage(0, std::as_bytes(std::span(lattices)));
    r.storage(tables_binding, a.depths);
  }
  r.each_pixel(program, a.mean_depth.extent, progress);
}

}  // namespace airlight
