#include <algorithm>
#include <vector>

#include "gpu/network.h"

namespace airlight {

void run(const NetworkIteration& a, StepRunner& r, const Progress& progress) {
  constexpr GLuint words_number = 50, taken_number = 51, matrix_number = 52, residuals_number = 53;  // buffers of this step
  const NetworkShape shape = a.shape();
  const bool isotropic = a.phase.kind == PhaseKind::isotropic;
  const std::size_t n = shape.particles, directions = 2 * shape.lines, sources = isotropic ? n : n * directions;
  bind_network(r, a,
               {.slots = static_cast<std::int32_t>(shape.slots),
                .phase_kind = static_cast<std::int32_t>(a.phase.kind),
                .phase_g = static_cast<float>(a.phase.g)});
  const std::string kind = isotropic ? "ISOTROPIC" : "";
  const auto each = [&](const char* define, std::size_t items) {
    r.each(r.compute("gpu/network_iteration.glsl", {define, kind}), items, network_group);
  };

  // Changes, weights of each line's links, and what becomes of them.
  r.reserve(words_number, network_bytes(r, sizeof(float) * (2 + n * shape.lines + sources)));
  network_bytes(r, a.sources.bytes);
  r.storage(0, a.links);
  r.storage(3, a.sources);
  r.bind(5, words_number);
  r.storage(6, a.first);
  r.reserve(taken_number, network_bytes(r, 4 * sizeof(float) * n * (isotropic ? shape.lines : directions)));
  r.bind(4, taken_number);
  if (!isotropic) {
    r.reserve(matrix_number, network_bytes(r, sizeof(float) * directions * directions));
    r.bind(7, matrix_number);
    each("PHASES", directions * directions);
  }
  each("START", sources);
  each("WEIGHTS", shape.lines * shape.slots);
  each("SHARES", sources);
  std::vector<float> residuals(1 + static_cast<std::size_t>(a.iterations), 0.0F);
  for (int k = 0; k < a.iterations; ++k) {
    progress.check();
    float state[2] = {0, 0};
    r.write_storage(words_number, 0, std::as_bytes(std::span(state)));
    each("SWEEP", (isotropic ? shape.lines : directions) * shape.slots);
    each("SCATTER", sources);
    r.read_storage(words_number, std::as_writable_bytes(std::span(state)));
    const float residual = state[0] / std::max(state[1], 1e-30F);
    residuals[0] = static_cast<float>(k + 1);
    residuals[static_cast<std::size_t>(1 + k)] = residual;
    if (residual <= a.tolerance) break;
  }
  r.fill(residuals_number, std::as_bytes(std::span(residuals)));
  r.copy_back(residuals_number, r.buffer_name(a.residuals), a.residuals.bytes);
}

}  // namespace airlight
