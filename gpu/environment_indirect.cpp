#include <algorithm>
#include <glm/vec4.hpp>

#include "common/algorithms/environment_light.h"
#include "common/plan/surface_airlight_tables.h"
#include "gpu/step_runner.h"

namespace airlight {

void run(const EnvironmentIndirect& a, StepRunner& r, const Progress& progress) {
  Program& program =
      r.compute("gpu/environment_indirect.glsl", {a.scattering == EnvironmentScattering::published ? "PUBLISHED" : "",
                                                  a.scattered ? "WITH_MORE" : "", a.mean_depth ? "WITH_MEDIUM" : ""});
  r.read(1, a.normal);
  r.read(2, a.material);
  r.read(3, a.transmittance);
  if (a.scattered) r.read(4, a.scattered);
  if (a.mean_depth) r.read(5, a.mean_depth);
  r.write(0, a.indirect);
  r.storage(tables_binding, a.tables);
  // Two vectors a material: diffuse; specular and where its lobe's table begins.
  const std::vector<float> shininess = shininess_of(a.materials);
  std::vector<glm::vec4> materials;
  for (const Material& m : a.materials) {
    const auto k = std::lower_bound(shininess.begin(), shininess.end(), m.shininess) - shininess.begin();
    materials.emplace_back(m.diffuse, 0);
    materials.emplace_back(m.specular, static_cast<float>((static_cast<std::size_t>(k) + 1) * environment_lobe_floats));
  }
  r.storage(0, std::as_bytes(std::span(materials)));
  r.view(a.view);
  struct {
    glm::vec4 albedo, gaussian_albedo_share;
  } const knobs{{a.albedo, 0}, {a.gaussian_albedo, static_cast<float>(environment_share_floats)}};
  r.block(knobs_binding, knobs);
  r.each_pixel(program, a.indirect.extent, progress);
}

}  // namespace airlight
