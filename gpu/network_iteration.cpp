#include <algorithm>
#include <vector>

#include "common/algorithms/gradients.h"
#include "gpu/network.h"

namespace airlight {

namespace {

constexpr GLuint words_number = 50, taken_number = 51, matrix_number = 52, residuals_number = 53,
                 way_number = 54;  // of this step

// Light is swept here; sources are told between, of few floats beside all links.
template <class Each>
void run_gradients(const NetworkIteration& a, StepRunner& r, const Progress& progress, std::size_t sky_at, Each&& each) {
  const NetworkShape shape = a.shape();
  const std::size_t n = shape.particles;
  const auto floats_of = [](const std::vector<std::byte>& bytes) {
    return std::span(reinterpret_cast<const float*>(bytes.data()), bytes.size() / sizeof(float));
  };
  const std::vector<std::byte> first = r.content(a.first), particles = r.content(a.particles);
  const std::vector<float> no_sky(8 * shape.lines, 0.0F);
  std::vector<float> share(n), taken(4 * n), residuals(a.residual_floats(), 0.0F);
  r.read_storage(words_number, std::as_writable_bytes(std::span(share)));
  Gradients gradients(floats_of(first), floats_of(particles).subspan(particle_albedo * n, 3 * n), share);
  for (int k = 0; k < a.iterations; ++k) {
    progress.check();
    r.fill(way_number, std::as_bytes(gradients.way()));
    r.bind(3, way_number);
    each("SWEEP", shape.lines * shape.slots);
    each("TAKEN", n);
    r.read_storage(taken_number, std::as_writable_bytes(std::span(taken)));
    if (k == 0) r.write_storage(words_number, sky_at, std::as_bytes(std::span(no_sky)));
    gradients.take(taken);
    if (a.add_round(residuals, k, gradients.change(), gradients.left_out())) break;
  }
  gradients.finish(taken);
  r.fill(way_number, std::as_bytes(std::span(taken)));
  r.copy_back(way_number, r.buffer_name(a.sources), a.sources.bytes);
  r.fill(residuals_number, std::as_bytes(std::span(residuals)));
  r.copy_back(residuals_number, r.buffer_name(a.residuals), a.residuals.bytes);
}

}  // namespace

void run(const NetworkIteration& a, StepRunner& r, const Progress& progress) {
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

  // What changed of each particle and the sum of what it sends; weights of each line's links, and what becomes of them;
  // the sky; areas of lists.
  r.reserve(words_number, sizeof(float) * (2 * n + n * shape.lines + sources + 4 * directions + shape.lines * shape.slots));
  r.storage(0, a.links);
  r.storage(3, a.sources);
  r.bind(5, words_number);
  r.storage(6, a.first);
  r.reserve(taken_number, 4 * sizeof(float) * n * (isotropic ? shape.lines : directions));
  r.bind(4, taken_number);
  if (!isotropic) {
    r.reserve(matrix_number, sizeof(float) * directions * directions);
    r.bind(7, matrix_number);
    each("PHASES", directions * directions);
  }
  const std::size_t sky_at = sizeof(float) * (2 * n + n * shape.lines + sources);
  const std::vector<float> no_sky(a.sky ? 0 : 4 * directions, 0.0F);
  if (a.sky) {
    r.copy(r.buffer_name(a.sky), words_number, sky_at, 4 * sizeof(float) * directions);
  } else {
    r.write_storage(words_number, sky_at, std::as_bytes(std::span(no_sky)));
  }
  each("START", sources);
  each("WEIGHTS", shape.lines * shape.slots);
  each("SHARES", sources);
  if (a.gradients) {
    run_gradients(a, r, progress, sky_at, each);
    return;
  }
  std::vector<float> residuals(a.residual_floats(), 0.0F);
  std::vector<float> changes(2 * n);
  for (int k = 0; k < a.iterations; ++k) {
    progress.check();
    each("SWEEP", (isotropic ? shape.lines : directions) * shape.slots);
    each("SCATTER", sources);
    each("SUMS", n);
    r.read_storage(words_number, std::as_writable_bytes(std::span(changes)));
    double change = 0, sum = 0;
    for (std::size_t v = 0; v < n; ++v)
      change += static_cast<double>(changes[2 * v]), sum += static_cast<double>(changes[2 * v + 1]);
    if (a.add_round(residuals, k, change / std::max(sum, 1e-30))) break;
  }
  r.fill(residuals_number, std::as_bytes(std::span(residuals)));
  r.copy_back(residuals_number, r.buffer_name(a.residuals), a.residuals.bytes);
}

}  // namespace airlight
