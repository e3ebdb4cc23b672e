#include <vector>

#include "gpu/medium.h"
#include "gpu/network.h"

namespace airlight {

void run(const VisibilityNetwork& a, StepRunner& r, const Progress& progress) {
  constexpr GLuint scratch_number = 50;  // a buffer of this step
  const NetworkShape shape = a.shape();
  loop_budget(a.gaussians, a.grid, a.samples, LightDepth::analytic, 1);  // links have as many loops as ways to a light
  const std::vector<std::string> medium = bind_medium(r, a.gaussians, a.grid, a.voxels, 1, LightDepth::analytic);
  bind_network(
      r, a, {.slots = static_cast<std::int32_t>(shape.slots), .unit = a.unit, .extinction = a.extinction, .samples = a.samples});
  r.storage(0, a.links);
  // Counts, sums and what is given out of them begin with 0.
  const std::size_t pairs = shape.lines * shape.particles;
  const std::vector<std::int32_t> zeros(4 * shape.lines * shape.slots + 4 * pairs, 0);
  r.fill(scratch_number, std::as_bytes(std::span(zeros)));
  r.bind(3, scratch_number);
  const auto each = [&](const char* define, std::size_t items) {
    progress.check();
    std::vector<std::string> defines = medium;
    defines.push_back(define);
    r.each(r.compute("gpu/visibility_network.glsl", defines), items, network_group);
  };
  each("COUNT", pairs);
  each("BEGIN", shape.lines);
  each("FILL", pairs);
  each("RANK", pairs);
  each("LINKS", pairs);
}

}  // namespace airlight
