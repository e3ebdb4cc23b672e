#include "common/plan/surface_airlight_tables.h"
#include "common/plan/surface_psf.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

// `uneven`: with a depth toward each light, made up.
Case indirect(Extent extent, const std::vector<Light>& lights, const std::vector<Material>& materials, Phase phase,
              float extinction, bool uneven = false, SurfaceScattering scattering = SurfaceScattering::tables) {
  Case c;
  const View view = test_view(extent);
  const TestSurfaces surfaces = sphere_on_plane(view, 1);
  add_to(c, surfaces);
  const Image transmittance{{4}, Format::r32f, extent, 1, false};
  std::vector<float> through(transmittance.floats());
  for (std::uint32_t i = 0; i < through.size(); ++i) through[i] = static_cast<float>(uniform(4, i));
  c.images.emplace_back(transmittance, std::move(through));
  const Image toward{{7}, Format::r32f, extent, static_cast<int>(lights.size()), false};
  if (uneven) {
    std::vector<float> depths(toward.floats());
    for (std::uint32_t i = 0; i < depths.size(); ++i)
      depths[i] = i % 5 == 0 ? 0.0F : static_cast<float>(4 * uniform(5, i) * uniform(6, i));
    c.images.emplace_back(toward, std::move(depths));
  }
  const std::vector<float> shininess = shininess_of(materials);
  const std::vector<float> tables =
      scattering == SurfaceScattering::psf ? surface_psf_tables(shininess) : surface_airlight_tables(phase, shininess);
  const auto bytes = std::as_bytes(std::span(tables));
  const Buffer buffer{{5}, bytes.size()};
  c.buffers.emplace_back(buffer, std::vector<std::byte>(bytes.begin(), bytes.end()));
  const Image result{{6}, Format::rgb32f, extent, 1, true};
  c.steps = {{SurfaceAirlight{.distance = surfaces.distance,
                              .normal = surfaces.normal,
                              .material = surfaces.material,
                              .transmittance = transmittance,
                              .depth_toward_light = uneven ? toward : Image{},
                              .tables = buffer,
                              .materials = materials,
                              .lights = lights,
                              .view = view,
                              .extinction = extinction,
                              .albedo = {0.9F, 0.8F, 0.7F},
                              .rest_albedo = {0.5F, 0.7F, 1},
                              .scattering = scattering,
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

Case through_gaussians(Extent e) {
  return indirect(e, test_lights(), test_materials(), {PhaseKind::henyey_greenstein, 0.4}, 0.1F, true);
}
Case without_fog(Extent e) { return indirect(e, test_lights(), test_materials(), {PhaseKind::isotropic, 0}, 0, true); }
Case by_psf(Extent e) {
  return indirect(e, test_lights(), test_materials(), {PhaseKind::isotropic, 0}, 0.1F, true, SurfaceScattering::psf);
}
Case fog_by_psf(Extent e) {
  return indirect(e, test_lights(), {test_materials()[0], test_materials()[0]}, {PhaseKind::isotropic, 0}, 0.2F, false,
                  SurfaceScattering::psf);
}

}  // namespace

std::span<const NamedCase> surface_airlight_cases() {
  static constexpr NamedCase cases[] = {{"surface_airlight/three_lights_two_materials", all_lights},
                                        {"surface_airlight/one_lamp", diffuse},
                                        {"surface_airlight/shininess_1_and_1000", glossy},
                                        {"surface_airlight/through_gaussians", through_gaussians},
                                        {"surface_airlight/gaussians_without_fog", without_fog},
                                        {"surface_airlight/by_the_psf", by_psf},
                                        {"surface_airlight/fog_by_the_psf", fog_by_psf}};
  return cases;
}

}  // namespace airlight
