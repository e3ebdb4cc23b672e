#include "common/plan/brdf.h"
#include "tests/parity/brdfs.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

Case shading(Extent extent, std::vector<Light> lights, std::vector<Material> materials, bool light_transmittance,
             bool with_environment = false, const std::vector<std::shared_ptr<const Brdf>>& brdfs = {},
             const std::vector<int>& brdf = {}) {
  Case c;
  const View view = test_view(extent);
  TestSurfaces surfaces = sphere_on_plane(view, 1);
  if (materials.size() == 1) {
    for (float& m : surfaces.materials) m = std::min(m, 0.0F);
  }
  add_to(c, surfaces);
  const auto random_image = [&](std::uint32_t id, int layers) {
    const Image image{{id}, Format::r32f, extent, layers, false};
    std::vector<float> values(image.floats());
    for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(uniform(id, i));
    c.images.emplace_back(image, std::move(values));
    return image;
  };
  Image environment;
  if (with_environment) {
    environment = {{9}, Format::rgb32f, extent, 1, false};
    std::vector<float> values(environment.floats());
    for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(uniform(9, i));
    c.images.emplace_back(environment, std::move(values));
  }
  Buffer tables;
  if (!brdfs.empty()) {
    const std::vector<float> values = brdf_tables(brdfs);
    const auto bytes = std::as_bytes(std::span(values));
    tables = {{10}, bytes.size()};
    c.buffers.emplace_back(tables, std::vector<std::byte>(bytes.begin(), bytes.end()));
  }
  const Image surface{{6}, Format::rgb32f, extent, 1, true}, direct{{7}, Format::rgb32f, extent, 1, true},
      ambient{{8}, Format::rgb32f, extent, 1, true};
  c.steps = {
      {SurfaceShading{.distance = surfaces.distance,
                      .normal = surfaces.normal,
                      .material = surfaces.material,
                      .transmittance = random_image(4, 1),
                      .light_transmittance = light_transmittance ? random_image(5, static_cast<int>(lights.size())) : Image{},
                      .indirect = {},
                      .environment = environment,
                      .brdfs = tables,
                      .materials = materials,
                      .brdf = brdf,
                      .brdf_at = brdf_places(brdfs),
                      .lights = lights,
                      .view = view,
                      .extinction = 0.1F,
                      .ambient = {0.02F, 0.03F, 0.04F},
                      .background = {0.1F, 0.2F, 0.3F},
                      .surface = surface,
                      .surface_direct = direct,
                      .surface_ambient = ambient},
       ""}};
  c.results = {{"surface", surface}, {"surface.direct", direct}, {"surface.ambient", ambient}};
  return c;
}

Case all_lights(Extent e) { return shading(e, test_lights(), test_materials(), true); }
Case one_lamp(Extent e) { return shading(e, {test_lights()[0]}, {test_materials()[0]}, false); }
Case mirror_like(Extent e) {
  std::vector<Material> materials = test_materials();
  materials[1].shininess = 1000;
  return shading(e, test_lights(), materials, false);
}
Case under_the_sky(Extent e) { return shading(e, {test_lights()[0]}, test_materials(), false, true); }
Case dark(Extent e) { return shading(e, {}, test_materials(), false); }

Case tabulated(Extent e) {
  return shading(e, test_lights(), test_materials(), true, false,
                 {microfacet_table({8, 8, 8}, 0.6, 0.5), microfacet_table({24, 12, 12}, 0.3)}, {1, 0});
}
Case tabulated_and_matt(Extent e) {
  return shading(e, test_lights(), test_materials(), false, true, {microfacet_table({90, 20, 36}, 0.2)}, {-1, 0});
}
Case only_tabulated(Extent e) {
  return shading(e, {test_lights()[0]}, {test_materials()[1]}, false, false, {constant_table({0.1F, 0.2F, 0.3F})}, {0});
}

}  // namespace

std::span<const NamedCase> surface_shading_cases() {
  static constexpr NamedCase cases[] = {{"surface_shading/three_lights_two_materials", all_lights},
                                        {"surface_shading/one_lamp", one_lamp},
                                        {"surface_shading/shininess_1000", mirror_like},
                                        {"surface_shading/with_environment", under_the_sky},
                                        {"surface_shading/no_light", dark},
                                        {"surface_shading/two_tabulated", tabulated},
                                        {"surface_shading/tabulated_and_matt", tabulated_and_matt},
                                        {"surface_shading/one_tabulated_lamp", only_tabulated}};
  return cases;
}

}  // namespace airlight
