#include "common/plan/airlight_tables.h"
#include "common/plan/shadow_volumes.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

// The shadows of the scene's casters over a sphere on a plane, which need not be what casts them.
Case shadows(const Scene& scene, Extent extent, float sky_distance, ShadowOrder order = ShadowOrder::exact) {
  Case c;
  View view = test_view(extent);
  const TestSurfaces surfaces = sphere_on_plane(view, 1);
  add_to(c, surfaces);
  std::vector<std::size_t> index;
  std::vector<Light> lights;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const LightSource& from = scene.lights[i];
    index.push_back(i);
    const HomogeneousLight near = light_near_camera(scene, i);
    lights.push_back({.vector = near.point > 0 ? near.vector : -near.vector,
                      .power = from.power,
                      .radius = static_cast<float>(from.radius),
                      .directional = from.type == LightType::directional});
  }
  const std::vector<float> tables = airlight_tables(scene.medium.phase, 64);
  const auto bytes = std::as_bytes(std::span(tables));
  const Buffer buffer{{4}, bytes.size()};
  c.buffers.emplace_back(buffer, std::vector<std::byte>(bytes.begin(), bytes.end()));
  const Plan::Upload volumes = shadow_volumes_upload(scene, index, order, 1, 5);
  c.buffers.emplace_back(volumes.buffer, volumes.make());
  const int layers = static_cast<int>(lights.size());
  const Image scattered{{6}, Format::r32f, extent, layers, true}, lit{{7}, Format::r32f, extent, layers, true};
  c.steps = {{ShadowPlanes{.distance = surfaces.distance,
                           .volumes = volumes.buffer,
                           .tables = buffer,
                           .lights = lights,
                           .view = view,
                           .phase = scene.medium.phase,
                           .order = order,
                           .extinction = static_cast<float>(scene.medium.extinction),
                           .sky_distance = sky_distance,
                           .scattered = scattered,
                           .light_transmittance = lit},
              ""}};
  c.results = {{"scattered", scattered}, {"light_transmittance", lit}};
  return c;
}

Case torus(Extent e) { return shadows(lit_scene(wavy_torus(2000), {-0.4, 0.3, -4.6}, 0.5), e, 1e30F); }
Case fine_torus(Extent e) { return shadows(lit_scene(wavy_torus(100000), {-0.4, 0.3, -4.6}, 0.5), e, 30); }
Case open_square(Extent e) { return shadows(lit_scene(square(1), {-0.5, 0.2, -4.5}, 0.8), e, 1e30F); }
Case many_slats(Extent e) { return shadows(lit_scene(slats(150), {-0.8, 0.4, -4.4}, 1.6), e, 1e30F); }
Case camera_in_shadow(Extent e) {  // between the slats and in the middle of the beams of the directional light
  return shadows(lit_scene(slats(7), {0.3, 1.5, -0.4}, 2), e, 1e30F);
}
Case light_behind(Extent e) {
  Scene scene = lit_scene(wavy_torus(2000), {0.1, 0.1, 0.6}, 0.3);
  scene.lights.resize(1);
  scene.lights[0].position = {0.3, 0.5, 2.5};
  return shadows(scene, e, 1e30F);
}
Case lamp_inside(Extent e) {  // an all but closed box around the first lamp
  Scene scene = lit_scene(slats(9), {-1.2, 0.8, -4.2}, 0.6);
  Surface lid = scene.surfaces[0];
  lid.mesh = square(1);
  lid.transform[3] = {-1.2, 1.5, -4.2, 1};
  scene.surfaces.push_back(lid);
  return shadows(scene, e, 1e30F);
}
Case nothing_seen(Extent e) {  // planes behind the camera and out of view alone
  Scene scene = lit_scene(square(0.2), {0, -3, 2}, 1);
  scene.lights.resize(1);
  return shadows(scene, e, 1e30F);
}
Case no_medium(Extent e) {
  Scene scene = lit_scene(wavy_torus(2000), {-0.4, 0.3, -4.6}, 0.5);
  scene.medium.extinction = 0;
  return shadows(scene, e, 1e30F);
}
// As published, in scenes where planes interleave.
Case published_torus(Extent e) {
  return shadows(lit_scene(wavy_torus(2000), {-0.4, 0.3, -4.6}, 0.5), e, 1e30F, ShadowOrder::published);
}
Case published_slats(Extent e) { return shadows(lit_scene(slats(150), {-0.8, 0.4, -4.4}, 1.6), e, 30, ShadowOrder::published); }
Case published_camera_in_shadow(Extent e) {
  return shadows(lit_scene(slats(7), {0.3, 1.5, -0.4}, 2), e, 1e30F, ShadowOrder::published);
}

}  // namespace

std::span<const NamedCase> shadow_planes_cases() {
  static constexpr NamedCase cases[] = {{"shadow_planes/torus_2k", torus},
                                        {"shadow_planes/torus_100k", fine_torus},
                                        {"shadow_planes/open_square", open_square},
                                        {"shadow_planes/slats", many_slats},
                                        {"shadow_planes/camera_in_shadow", camera_in_shadow},
                                        {"shadow_planes/light_behind", light_behind},
                                        {"shadow_planes/lamp_inside", lamp_inside},
                                        {"shadow_planes/out_of_view", nothing_seen},
                                        {"shadow_planes/no_medium", no_medium},
                                        {"shadow_planes/published_torus_2k", published_torus},
                                        {"shadow_planes/published_slats", published_slats},
                                        {"shadow_planes/published_in_shadow", published_camera_in_shadow}};
  return cases;
}

}  // namespace airlight
