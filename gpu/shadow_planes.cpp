#include "gpu/shadow_runs.h"

namespace airlight {

void run(const ShadowPlanes& a, StepRunner& r, const Progress& progress) {
  const std::string lights = r.lights(a.lights);
  Program& program = r.compute("gpu/shadow_planes.glsl", {lights, a.scattered ? "WITH_SCATTERED" : "",
                                                          a.light_transmittance ? "WITH_LIGHT_TRANSMITTANCE" : "",
                                                          a.order == ShadowOrder::published ? "PUBLISHED_ORDER" : ""});
  r.read(0, a.distance);
  r.write(0, a.scattered);
  r.write(1, a.light_transmittance);
  if (a.tables) r.storage(tables_binding, a.tables);
  r.view(a.view);
  struct {
    float extinction, g;
    int kind, unused;
  } const knobs{a.extinction, static_cast<float>(a.phase.g), static_cast<int>(a.phase.kind), 0};
  r.block(knobs_binding, knobs);
  program.set("first_row", 0);
  each_shadow_run(a.view, a.lights.size(), a.volumes, a.sky_distance, r, program, progress, {});
}

}  // namespace airlight
