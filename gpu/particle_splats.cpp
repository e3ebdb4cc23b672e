#include <glm/vec4.hpp>

#include "common/plan/gaussian_bins.h"
#include "gpu/network.h"

namespace airlight {

void run(const ParticleSplats& a, StepRunner& r, const Progress& progress) {
  // Bindings of storage buffers, and the number of this step's own.
  constexpr GLuint splats_binding = 0, radiance_binding = 1, sources_binding = 2, lines_binding = 3, bins_binding = 2;
  constexpr GLuint radiance_number = 54;
  const auto particles = static_cast<std::size_t>(a.particle_count);
  struct {
    glm::vec4 ambient_sky_distance;
    float extinction, inverse_reach, least_seen;
    std::int32_t particle_count, line_count, side, columns;
  } const knobs{{a.ambient, a.sky_distance},
                a.extinction,
                a.inverse_reach(),
                ParticleSplats::least_seen,
                a.particle_count,
                a.line_count,
                bin_side,
                bin_columns(a.view.extent)};
  r.block(knobs_binding, knobs);
  r.storage(splats_binding, a.splats);
  r.reserve(radiance_number, sizeof(glm::vec4) * particles);
  r.bind(radiance_binding, radiance_number);
  r.storage(sources_binding, a.particle_sources);
  r.storage(lines_binding, a.lines);
  r.each(r.compute("gpu/particle_splats.glsl", {"RADIANCE", a.directions() == 1 ? "ISOTROPIC" : ""}), particles, network_group);

  r.read(0, a.distance);
  if (a.scattered) r.read(1, a.scattered);
  r.write(0, a.airlight);
  r.write(1, a.transmittance);
  r.write(2, a.optical_depth);
  r.storage(bins_binding, a.bins);
  r.view(a.view);
  r.each_pixel(
      r.compute("gpu/particle_splats.glsl", {a.scattered ? "WITH_SCATTERED" : "", a.optical_depth ? "WITH_OPTICAL_DEPTH" : ""}),
      a.airlight.extent, progress);
}

}  // namespace airlight
