#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "common/error.h"
#include "gpu/step_runner.h"

namespace airlight {

void run(const SurfaceShading& a, StepRunner& r, const Progress& progress) {
  const std::string lights = r.lights(a.lights);
  Program& program =
      r.compute("gpu/surface_shading.glsl",
                {lights, a.light_transmittance ? "WITH_LIGHT_TRANSMITTANCE" : "", a.surface_direct ? "WITH_DIRECT" : "",
                 a.surface_ambient ? "WITH_AMBIENT" : "", a.indirect ? "WITH_INDIRECT" : "",
                 a.environment ? "WITH_ENVIRONMENT" : "", a.brdfs ? "WITH_BRDFS" : ""});
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
  if (a.brdfs) {
    if (a.brdfs.bytes > r.storage_limit()) {
      throw MachineError("OpenGL: the tabulated reflectances take " + std::to_string(a.brdfs.bytes >> 20U) +
                         " MiB, more than a storage buffer may have (" + std::to_string(r.storage_limit() >> 20U) + ")");
    }
    // Where each material's table begins, -1: none.
    std::vector<int> places;
    for (const int b : a.brdf) places.push_back(b < 0 ? -1 : a.brdf_at[static_cast<std::size_t>(b)]);
    r.storage(tables_binding, a.brdfs);
    r.storage(1, std::as_bytes(std::span(places)));
  }
  r.view(a.view);
  struct {
    glm::vec4 ambient_extinction, background;
  } const knobs{{a.ambient, a.extinction}, {a.background, 0}};
  r.block(knobs_binding, knobs);
  r.each_pixel(program, a.surface.extent, progress);
}

}  // namespace airlight
