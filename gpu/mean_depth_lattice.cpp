#include "gpu/gaussian_mean_depth.h"

namespace airlight {

void run(const MeanDepthLattice& a, StepRunner& r, const Progress& progress) {
  Program& program = r.compute("gpu/mean_depth_lattice.glsl", {});
  bind_mean_depth(r, a.gaussians);
  r.storage(0, a.depths);
  program.set("gaussian_count", static_cast<int>(a.gaussians.size()));
  for (const DepthLattice& l : a.lattices) {
    progress.check();
    const int nodes = l.nodes.x * l.nodes.y * l.nodes.z, padding = &l == &a.lattices.back() ? depth_lattice_padding : 0;
    program.set("nodes_x", l.nodes.x);
    program.set("nodes_y", l.nodes.y);
    program.set("node_count", nodes);
    program.set("first_node", l.first);
    program.set("padding", padding);
    program.set("corner", l.corner);
    program.set("spacing", l.spacing);
    r.each(program, static_cast<std::size_t>(nodes) + static_cast<std::size_t>(padding), 64);
  }
}

}  // namespace airlight
