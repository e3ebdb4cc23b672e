#include <glm/vec4.hpp>

#include "gpu/step_runner.h"

namespace airlight {

void run(const SurfaceShading& a, StepRunner& r, const Progress& progress) {
  const std::string lights = r.lights(a.lights);
  Program& program =
      r.compute("gpu/surface_shading.glsl", {lights, a.light_transmittance ? "WITH_LIGHT_TRANSMITTANCE" : "",
                                             a.surface_direct ? "WITH_DIRECT" : "", a.surface_ambient ? "WITH_AMBIENT" : "",
                                             a.indirect ? "WITH_INDIRECT" : "", a.environment ? "WITH_ENVIRONMENT" : ""});
  r.read(0, a.distance);
  r.read(1, a.normal);
  r.read(2, a.material);
  r.read(3, a.transmittance);
  if (a.light_transmittance) r.read(4, a.light_transmittance);
  if (a.indirect) r.read(5, a.indirect);
  if (a.environment) r.read(6, a.environment);
  r.write(0, a.surface);
  r.write(1, a.surface_direct);
  r.write(2, a.surface_ambient);
  static_assert(sizeof(Material) == 7 * sizeof(float));
  r.storage(0, std::as_bytes(std::span(a.materials)));
  r.view(a.view);
  struct {
    glm::vec4 ambient_extinction, background;
  } const knobs{{a.ambient, a.extinction}, {a.background, 0}};
  r.block(knobs_binding, knobs);
  r.each_pixel(program, a.surface.extent, progress);
}

}  // namespace airlight
