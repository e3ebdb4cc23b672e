#include <algorithm>
#include <glm/vec4.hpp>

#include "common/plan/surface_airlight_tables.h"
#include "common/plan/surface_psf.h"
#include "gpu/step_runner.h"

namespace airlight {

void run(const SurfaceAirlight& a, StepRunner& r, const Progress& progress) {
  const std::string lights = r.lights(a.lights);
  const bool psf = a.scattering == SurfaceScattering::psf;
  Program& program =
      r.compute("gpu/surface_airlight.glsl", {lights, a.depth_toward_light ? "WITH_DEPTH" : "", psf ? "WITH_PSF" : ""});
  r.read(0, a.distance);
  r.read(1, a.normal);
  r.read(2, a.material);
  r.read(3, a.transmittance);
  if (a.depth_toward_light) r.read(4, a.depth_toward_light);
  r.write(0, a.indirect);
  r.storage(tables_binding, a.tables);
  // Two vectors a material: diffuse; specular and where its table begins.
  const std::vector<float> shininess = shininess_of(a.materials);
  const std::size_t floats = psf ? surface_psf_floats : surface_airlight_floats;
  std::vector<glm::vec4> values;
  for (const Material& m : a.materials) {
    const auto k = std::lower_bound(shininess.begin(), shininess.end(), m.shininess) - shininess.begin();
    values.emplace_back(m.diffuse, 0);
    values.emplace_back(m.specular, static_cast<float>((static_cast<std::size_t>(k) + 1) * floats));
  }
  r.storage(0, std::as_bytes(std::span(values)));
  r.view(a.view);
  struct {
    glm::vec4 albedo_extinction, rest_albedo;
  } const knobs{{a.albedo, a.extinction}, {a.rest_albedo, 0}};
  r.block(knobs_binding, knobs);
  r.each_pixel(program, a.indirect.extent, progress);
}

}  // namespace airlight
