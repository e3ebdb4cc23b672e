#include "common/algorithms/environment_light.h"
#include "common/plan/surface_airlight_tables.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

// Tables made up, but for shares between 1/2 and 1.
std::vector<float> made_up(std::size_t lobes) {
  std::vector<float> tables;
  for (std::uint32_t k = 0; k < lobes; ++k) {
    tables.push_back(64);
    for (std::uint32_t i = 0; i < 65; ++i) tables.push_back(0.5F + static_cast<float>(i) / 128);
    for (std::uint32_t i = 0; i < 108; ++i)
      tables.push_back(static_cast<float>((i % 36 == 0 ? 3 : 0) + 0.5 * uniform(181 + k, i) - 0.25));
  }
  return tables;
}

Case scattered(Extent extent, const std::vector<Material>& materials, bool medium, glm::vec3 albedo,
               EnvironmentScattering scattering, bool more) {
  Case c;
  const View view = test_view(extent);
  TestSurfaces surfaces = sphere_on_plane(view, 1);
  if (materials.size() == 1) {
    for (float& m : surfaces.materials) m = std::min(m, 0.0F);
  }
  add_to(c, surfaces);
  const Image transmittance{{4}, Format::r32f, extent, 1, false}, before{{7}, Format::rgb32f, extent, 1, false};
  std::vector<float> through(transmittance.floats()), light(before.floats());
  for (std::uint32_t i = 0; i < through.size(); ++i) through[i] = static_cast<float>(uniform(4, i));
  for (std::uint32_t i = 0; i < light.size(); ++i) light[i] = static_cast<float>(uniform(6, i));
  c.images.emplace_back(transmittance, std::move(through));
  if (more) c.images.emplace_back(before, std::move(light));
  const std::vector<float> tables = made_up(1 + shininess_of(materials).size());
  const auto bytes = std::as_bytes(std::span(tables));
  const Buffer buffer{{5}, bytes.size()};
  c.buffers.emplace_back(buffer, std::vector<std::byte>(bytes.begin(), bytes.end()));
  Image mean_depth;
  if (medium) {
    mean_depth = {{8}, Format::r32f, extent, 1, false};
    std::vector<float> values(mean_depth.floats());
    for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(3 * uniform(10, i));
    c.images.emplace_back(mean_depth, std::move(values));
  }
  const Image result{{6}, Format::rgb32f, extent, 1, true};
  c.steps = {{EnvironmentIndirect{.distance = surfaces.distance,
                                  .normal = surfaces.normal,
                                  .material = surfaces.material,
                                  .transmittance = transmittance,
                                  .scattered = more ? before : Image{},
                                  .mean_depth = mean_depth,
                                  .tables = buffer,
                                  .materials = materials,
                                  .view = view,
                                  .albedo = albedo,
                                  .gaussian_albedo = {0.5F, 1, 1},
                                  .scattering = scattering,
                                  .indirect = result},
              ""}};
  c.results = {{"indirect", result}};
  return c;
}

Case fog(Extent e) {
  return scattered(e, {test_materials()[0]}, false, {0.9F, 0.8F, 0.7F}, EnvironmentScattering::depths, false);
}
Case both(Extent e) { return scattered(e, test_materials(), true, {0.9F, 0.8F, 0.7F}, EnvironmentScattering::depths, true); }
Case published(Extent e) { return scattered(e, test_materials(), true, glm::vec3(0), EnvironmentScattering::published, true); }

}  // namespace

std::span<const NamedCase> environment_indirect_cases() {
  static constexpr NamedCase cases[] = {
      {"environment_indirect/fog", fog}, {"environment_indirect/in_fog", both}, {"environment_indirect/published", published}};
  return cases;
}

}  // namespace airlight
