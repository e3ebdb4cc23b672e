#include <algorithm>
#include <array>
#include <glm/vec4.hpp>
#include <vector>

#include "gpu/network.h"

namespace airlight {

void run(const SourceFunction& a, StepRunner& r, const Progress& progress) {
  constexpr GLuint beams_number = 50, sums_number = 51, most_number = 52, head_number = 53;  // buffers of this step
  constexpr std::size_t chunk = 32;                                                          // lines whose beams are held at once
  const NetworkShape shape = a.shape();
  bind_network(r, a,
               {.slots = static_cast<std::int32_t>(shape.slots),
                .phase_kind = static_cast<std::int32_t>(a.phase.kind),
                .phase_g = static_cast<float>(a.phase.g),
                .unit = a.unit,
                .camera = glm::vec4(a.camera, 0)});
  const std::size_t nodes = a.all_nodes();
  r.storage(0, a.links);
  r.storage(3, a.particle_sources);
  r.reserve(beams_number, 8 * sizeof(float) * std::min(chunk, shape.lines) * shape.records());
  r.bind(4, beams_number);
  // Behind the sums where bricks are.
  std::vector<glm::vec4> bricks;
  for (std::size_t k = 0; k < a.filled.size(); ++k) {
    const std::array<std::int32_t, 3> at = a.brick(k);
    bricks.emplace_back(at[0], at[1], at[2], 0);
  }
  r.reserve(sums_number, sizeof(glm::vec4) * (nodes + bricks.size()));
  r.write_storage(sums_number, sizeof(glm::vec4) * nodes, std::as_bytes(std::span(bricks)));
  r.bind(5, sums_number);
  r.storage(6, a.sources);
  const float most = 0;
  r.fill(most_number, std::as_bytes(std::span(&most, 1)));
  if (a.sky) {
    r.storage(7, a.sky);
  } else {
    const std::vector<float> no_sky(8 * shape.lines, 0.0F);
    r.storage(7, std::as_bytes(std::span(no_sky)));
  }
  const auto each = [&](const char* define, std::size_t items, std::size_t first) {
    progress.check();
    Program& program = r.compute("gpu/source_function.glsl", {define});
    program.set("first_node", a.first);
    program.set("nodes", a.nodes);
    program.set("bricks", a.bricks);
    program.set("all_nodes", static_cast<int>(nodes));
    program.set("head_size", static_cast<int>(a.head_floats()));
    program.set("stride", a.stride);
    program.set("first_line", static_cast<int>(first));
    program.set("end_line", static_cast<int>(std::min(first + chunk, shape.lines)));
    r.each(program, items, network_group);
  };
  for (std::size_t first = 0; first < shape.lines; first += chunk) {
    each("BEAMS", std::min(chunk, shape.lines - first) * shape.slots, first);
    each("NODES", nodes, first);
  }
  r.bind(7, most_number);
  const std::vector<float> head = a.head();
  r.fill(head_number, std::as_bytes(std::span(head)));
  r.bind(4, head_number);
  each("MEANS", nodes, 0);
  each("HEAD", head.size(), 0);
}

}  // namespace airlight
