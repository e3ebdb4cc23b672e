#include <glm/vec4.hpp>

#include "gpu/step_runner.h"

namespace airlight {

void run(const HomogeneousAirlight& a, StepRunner& r, const Progress& progress) {
  const std::string lights = r.lights(a.lights);
  Program& program = r.compute("gpu/homogeneous_airlight.glsl",
                               {lights, a.per_light ? "WITH_PER_LIGHT" : "", a.scattered ? "WITH_SCATTERED" : ""});
  r.read(0, a.distance);
  if (a.scattered) r.read(1, a.scattered);
  r.write(0, a.airlight);
  r.write(1, a.per_light);
  if (a.tables) r.storage(tables_binding, a.tables);
  r.view(a.view);
  struct {
    glm::vec4 albedo_extinction, ambient_sky_distance, emission_g;
    int phase_kind, unused[3];
  } const knobs{{a.albedo, a.extinction},
                {a.ambient, a.sky_distance},
                {a.emission, static_cast<float>(a.phase.g)},
                static_cast<int>(a.phase.kind),
                {}};
  r.block(knobs_binding, knobs);
  r.each_pixel(program, a.airlight.extent, progress);
}

}  // namespace airlight
