#include "common/plan/environment.h"
#include "common/plan/surface_airlight_tables.h"
#include "tests/parity/brdfs.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

// A bright patch in a sky over dim ground, coloured, turned.
Environment test_environment(Extent extent) {
  auto image = std::make_shared<HostImage>(extent, 3);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const double sky = y < extent.height / 2 ? 0.5 : 0.1,
                   noise = uniform(180, static_cast<std::uint32_t>(x + extent.width * y));
      const bool sun = x > extent.width / 3 && x < extent.width / 2 && y < extent.height / 3;
      for (int c = 0; c < 3; ++c) image->at(x, y, c) = static_cast<float>((sky + 0.2 * noise) * (1 + 0.3 * c) + (sun ? 5 : 0));
    }
  }
  return {image, {1.2, 1.2, 1.2}, 30};
}

Case lit(Extent extent, const Environment& environment, const std::vector<Material>& materials, bool medium,
         bool partly_hidden = false, const std::vector<std::shared_ptr<const Brdf>>& brdfs = {},
         const std::vector<int>& brdf = {}) {
  Case c;
  const View view = test_view(extent);
  TestSurfaces surfaces = sphere_on_plane(view, 1);
  if (materials.size() == 1) {
    for (float& m : surfaces.materials) m = std::min(m, 0.0F);
  }
  add_to(c, surfaces);
  const Image transmittance{{4}, Format::r32f, extent, 1, false};
  std::vector<float> through(transmittance.floats());
  for (std::uint32_t i = 0; i < through.size(); ++i) through[i] = static_cast<float>(uniform(4, i));
  c.images.emplace_back(transmittance, std::move(through));
  const std::vector<float> tables = environment_table(environment, shininess_of(materials), brdfs);
  const auto bytes = std::as_bytes(std::span(tables));
  const Buffer buffer{{5}, bytes.size()};
  c.buffers.emplace_back(buffer, std::vector<std::byte>(bytes.begin(), bytes.end()));
  Image mean_depth;
  if (medium) {
    mean_depth = {{9}, Format::r32f, extent, 1, false};
    std::vector<float> values(mean_depth.floats());
    for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(3 * uniform(10, i));
    c.images.emplace_back(mean_depth, std::move(values));
  }
  Image hidden[2];
  for (std::uint32_t k = 0; k < 2 && partly_hidden; ++k) {
    hidden[k] = {{7 + k}, Format::rgb32f, extent, 1, false};
    std::vector<float> values(hidden[k].floats());
    for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(uniform(8 + k, i));
    c.images.emplace_back(hidden[k], std::move(values));
  }
  const Image result{{6}, Format::rgb32f, extent, 1, true};
  c.steps = {{EnvironmentLight{.distance = surfaces.distance,
                               .normal = surfaces.normal,
                               .material = surfaces.material,
                               .transmittance = transmittance,
                               .mean_depth = mean_depth,
                               .tables = buffer,
                               .hidden_diffuse = hidden[0],
                               .hidden_specular = hidden[1],
                               .materials = materials,
                               .brdf = brdf,
                               .view = view,
                               .environment = result},
              ""}};
  c.results = {{"environment", result}};
  return c;
}

Case image(Extent e) { return lit(e, test_environment({64, 32}), test_materials(), true); }
Case constant(Extent e) { return lit(e, {nullptr, {0.3, 0.5, 0.9}, 0}, {test_materials()[0]}, false); }
Case partly_hidden(Extent e) { return lit(e, test_environment({64, 32}), test_materials(), true, true); }
Case glossy(Extent e) {
  std::vector<Material> materials = test_materials();
  materials[0].specular = {0.3F, 0.2F, 0.1F};
  materials[0].shininess = 1;
  materials[1].shininess = 1000;
  return lit(e, test_environment({4, 2}), materials, true);
}

Case tabulated(Extent e) {
  return lit(e, test_environment({64, 32}), test_materials(), true, true,
             {microfacet_table({8, 8, 8}, 0.6), microfacet_table({24, 12, 12}, 0.3)}, {1, 0});
}
Case tabulated_and_matt(Extent e) {
  return lit(e, test_environment({4, 2}), test_materials(), false, false, {microfacet_table({24, 12, 12}, 0.4)}, {-1, 0});
}

}  // namespace

std::span<const NamedCase> environment_light_cases() {
  static constexpr NamedCase cases[] = {{"environment_light/image", image},
                                        {"environment_light/partly_hidden", partly_hidden},
                                        {"environment_light/constant_clear", constant},
                                        {"environment_light/shininess_1_and_1000", glossy},
                                        {"environment_light/two_tabulated", tabulated},
                                        {"environment_light/tabulated_and_matt", tabulated_and_matt}};
  return cases;
}

}  // namespace airlight
