#include <algorithm>
#include <glm/vec4.hpp>

#include "common/plan/surface_airlight_tables.h"
#include "gpu/step_runner.h"

namespace airlight {

void run(const SurfaceAirlight& a, StepRunner& r, const Progress& progress) {
  const std::string lights = r.lights(a.lights);
  Program& program = r.compute("gpu/surface_airlight.glsl", {lights});
  r.read(0, a.distance);
  r.read(1, a.normal);
  r.read(2, a.material);
  r.read(3, a.transmittance);
  r.write(0, a.indirect);
  r.storage(tables_binding, a.tables);
  // Two vectors a material: diffuse; specular and where its table begins.
  const std::vector<float> shininess = shininess_of(a.materials);
  std::vector<glm::vec4> values;
  for (const Material& m : a.materials) {
    const auto k = std::lower_bound(shininess.begin(), shininess.end(), m.shininess) - shininess.begin();
    values.emplace_back(m.diffuse, 0);
    values.emplace_back(m.specular, static_cast<float>((static_cast<std::size_t>(k) + 1) * surface_airlight_floats));
  }
  r.storage(0, std::as_bytes(std::span(values)));
  r.view(a.view);
  const glm::vec4 knobs(a.albedo, a.extinction);
  r.block(knobs_binding, knobs);
  r.each_pixel(program, a.indirect.extent, progress);
}

}  // namespace airlight
