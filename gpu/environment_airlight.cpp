#include <glm/vec4.hpp>

#include "gpu/step_runner.h"

namespace airlight {

void run(const EnvironmentAirlight& a, StepRunner& r, const Progress& progress) {
  Program& program =
      r.compute("gpu/environment_airlight.glsl", {a.scattering == EnvironmentScattering::published ? "PUBLISHED" : ""});
  r.read(0, a.distance);
  r.read(1, a.optical_depth);
  r.read(2, a.scattered);
  r.write(0, a.airlight);
  r.storage(tables_binding, a.tables);
  r.view(a.view);
  struct {
    glm::vec4 albedo_extinction, gaussian_albedo_sky_distance;
  } const knobs{{a.albedo, a.extinction}, {a.gaussian_albedo, a.sky_distance}};
  r.block(knobs_binding, knobs);
  r.each_pixel(program, a.airlight.extent, progress);
}

}  // namespace airlight
