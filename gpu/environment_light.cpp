#include <algorithm>
#include <glm/vec4.hpp>

#include "common/plan/surface_airlight_tables.h"
#include "gpu/step_runner.h"

namespace airlight {

void run(const EnvironmentLight& a, StepRunner& r, const Progress& progress) {
  Program& program = r.compute("gpu/environment_light.glsl",
                               {a.hidden_diffuse ? "WITH_HIDDEN_DIFFUSE" : "", a.hidden_specular ? "WITH_HIDDEN_SPECULAR" : "",
                                a.mean_depth ? "WITH_MEDIUM" : "", a.brdf.empty() ? "" : "WITH_BRDFS"});
  r.read(1, a.normal);
  r.read(2, a.material);
  r.read(3, a.transmittance);
  if (a.hidden_diffuse) r.read(4, a.hidden_diffuse);
  if (a.hidden_specular) r.read(5, a.hidden_specular);
  if (a.mean_depth) r.read(6, a.mean_depth);
  r.write(0, a.environment);
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
  // Where the lobes of each material's tabulated reflectance begin, -1: it has none.
  std::size_t brdfs = 0;
  if (!a.brdf.empty()) {
    std::vector<int> lobes;
    for (const int b : a.brdf) {
      lobes.push_back(b < 0 ? -1 : static_cast<int>(brdf_lobes_at(shininess.size(), static_cast<std::size_t>(b))));
      brdfs = std::max(brdfs, static_cast<std::size_t>(b + 1));
    }
    r.storage(2, std::as_bytes(std::span(lobes)));
  }
  r.view(a.view);
  const glm::ivec4 knobs(static_cast<int>(environment_image_at(shininess.size(), brdfs)),
                         static_cast<int>(environment_share_floats), static_cast<int>(environment_harmonics_at(shininess.size())),
                         0);
  r.block(knobs_binding, knobs);
  r.each_pixel(program, a.environment.extent, progress);
}

}  // namespace airlight
