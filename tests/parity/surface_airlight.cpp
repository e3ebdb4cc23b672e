#include "common/plan/surface_airlight_tables.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

Case indirect(Extent extent, const std::vector<Light>& lights, const std::vector<Material>& materials, Phase phase,
              float extinction) {
  Case c;
  const View view = test_view(extent);
  const TestSurfaces surfaces = sphere_on_plane(view, 1);
  add_to(c, surfaces);
  const Image transmittance{{4}, Format::r32f, extent, 1, false};
  std::vector<float> through(transmittance.floats());
  for (std::uint32_t i = 0; i < through.size(); ++i) through[i] = static_cast<float>(uniform(4, i));
  c.images.emplace_back(transmittance, std::move(through));
  const std::vector<float> tables = surface_airlight_tables(phase, shininess_of(materials));
  const auto bytes = std::as_bytes(std::span(tables));
  const Buffer buffer{{5}, bytes.size()};
  c.buffers.emplace_back(buffer, std::vector<std::byte>(bytes.begin(), bytes.end()));
  const Image result{{6}, Format::rgb32f, extent, 1, true};
  c.steps = {{SurfaceAirlight{.distance = surfaces.distance,
                              .normal = surfaces.normal,
                              .material = surfaces.material,
                              .transmittance = transmittance,
                              .tables = buffer,
                              .materials = materials,
                              .lights = lights,
                              .view = view,
                              .extinction = extinction,
                              .albedo = {0.9F, 0.8F, 0.7F},
                              .indirect = result},
              ""}};
  c.results = {{"indirect", result}};
  return c;
}

Case all_lights(Extent e) { return indirect(e, test_lights(), test_materials(), {PhaseKind::isotropic, 0}, 0.1F); }
Case diffuse(Extent e) {
  return indirect(e, {test_lights()[0]}, {test_materials()[0], test_materials()[0]}, {PhaseKind::rayleigh, 0}, 0.5F);
}
Case glossy(Extent e) {
  std::vector<Material> materials = test_materials();
  materials[0].specular = {0.3F, 0.2F, 0.1F};
  materials[0].shininess = 1;
  materials[1].shininess = 1000;
  return indirect(e, test_lights(), materials, {PhaseKind::henyey_greenstein, 0.6}, 0.1F);
}

}  // namespace

std::span<const NamedCase> surface_airlight_cases() {
  static constexpr NamedCase cases[] = {{"surface_airlight/three_lights_two_materials", all_lights},
                                        {"surface_airlight/one_lamp", diffuse},
                                        {"surface_airlight/shininess_1_and_1000", glossy}};
  return cases;
}

}  // namespace airlight
