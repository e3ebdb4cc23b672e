#include "common/plan/airlight_tables.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

Case airlight(Extent extent, const std::vector<Light>& lights, Phase phase, float extinction, float sky_distance) {
  Case c;
  const View view = test_view(extent);
  const TestSurfaces surfaces = sphere_on_plane(view, 1);
  add_to(c, surfaces);
  const std::vector<float> tables = airlight_tables(phase, 64);
  const auto bytes = std::as_bytes(std::span(tables));
  const Buffer buffer{{4}, bytes.size()};
  c.buffers.emplace_back(buffer, std::vector<std::byte>(bytes.begin(), bytes.end()));
  const Image total{{5}, Format::rgb32f, extent, 1, true};
  const Image parts{{6}, Format::rgb32f, extent, std::max(1, static_cast<int>(lights.size())), true};
  c.steps = {{HomogeneousAirlight{.distance = surfaces.distance,
                                  .tables = buffer,
                                  .scattered = {},
                                  .lights = lights,
                                  .view = view,
                                  .phase = phase,
                                  .extinction = extinction,
                                  .sky_distance = sky_distance,
                                  .albedo = {0.9F, 0.8F, 0.7F},
                                  .ambient = {0.01F, 0.02F, 0.03F},
                                  .emission = {0.003F, 0.002F, 0.001F},
                                  .airlight = total,
                                  .per_light = lights.empty() ? Image{} : parts},
              ""}};
  c.results = {{"airlight", total}};
  if (!lights.empty()) c.results.emplace_back("per_light", parts);
  return c;
}

Light lamp(float x, float y, float z) { return {.vector = {x, y, z}, .power = {10, 10, 10}}; }

Case two_lamps(Extent e) { return airlight(e, {test_lights()[0], test_lights()[1]}, {PhaseKind::isotropic, 0}, 0.1F, 1e30F); }
Case directional(Extent e) { return airlight(e, {test_lights()[2]}, {PhaseKind::rayleigh, 0}, 0.1F, 50); }
Case peaked(Extent e) { return airlight(e, test_lights(), {PhaseKind::henyey_greenstein, 0.9}, 0.2F, 1e30F); }
Case backward(Extent e) { return airlight(e, test_lights(), {PhaseKind::cornette_shanks, -0.6}, 0.2F, 1e30F); }
Case murky(Extent e) { return airlight(e, test_lights(), {PhaseKind::mie_murky, 0}, 0.05F, 1e30F); }
Case hazy(Extent e) { return airlight(e, test_lights(), {PhaseKind::mie_hazy, 0}, 0.05F, 1e30F); }
Case behind(Extent e) { return airlight(e, {lamp(0.2F, 0.5F, 3)}, {PhaseKind::isotropic, 0}, 0.2F, 1e30F); }
Case far_away(Extent e) { return airlight(e, {lamp(30, 40, 20)}, {PhaseKind::isotropic, 0}, 0.02F, 1e30F); }
Case in_camera(Extent e) { return airlight(e, {lamp(0, 0, 0)}, {PhaseKind::isotropic, 0}, 0.2F, 1e30F); }
Case dense(Extent e) { return airlight(e, test_lights(), {PhaseKind::isotropic, 0}, 30, 1e30F); }
Case thin(Extent e) { return airlight(e, test_lights(), {PhaseKind::isotropic, 0}, 1e-6F, 1e4F); }
Case vacuum(Extent e) { return airlight(e, test_lights(), {PhaseKind::isotropic, 0}, 0, 100); }
Case dark(Extent e) { return airlight(e, {}, {PhaseKind::isotropic, 0}, 0.1F, 1e30F); }

}  // namespace

std::span<const NamedCase> homogeneous_airlight_cases() {
  static constexpr NamedCase cases[] = {{"homogeneous_airlight/two_lamps", two_lamps},
                                        {"homogeneous_airlight/directional", directional},
                                        {"homogeneous_airlight/hg0.9", peaked},
                                        {"homogeneous_airlight/cs-0.6", backward},
                                        {"homogeneous_airlight/mie_murky", murky},
                                        {"homogeneous_airlight/mie_hazy", hazy},
                                        {"homogeneous_airlight/light_behind", behind},
                                        {"homogeneous_airlight/light_far_away", far_away},
                                        {"homogeneous_airlight/light_in_camera", in_camera},
                                        {"homogeneous_airlight/dense", dense},
                                        {"homogeneous_airlight/thin", thin},
                                        {"homogeneous_airlight/no_medium", vacuum},
                                        {"homogeneous_airlight/no_light", dark}};
  return cases;
}

}  // namespace airlight
