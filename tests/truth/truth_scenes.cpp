#include "tests/truth/truth_scenes.h"

#include <glm/gtc/matrix_transform.hpp>

#include "common/scene/load.h"
#include "tests/parity/inputs.h"
#include "tests/truth/scenes.h"

namespace airlight {

namespace {

Surface floor_at(double y, const Material& material) {
  Mesh mesh;
  add_parallelogram(mesh, {-8, y, 8}, {16, 0, 0}, {0, 0, -16});
  return surface(std::move(mesh), material, true);
}

Material shiny(const glm::vec3& diffuse_part, float specular, float shininess) {
  return {.diffuse = diffuse_part, .specular = glm::vec3(specular), .shininess = shininess};
}

Scene bunny_in_fog() {
  Scene scene = foggy_scene(0.12);
  scene.camera = {.position = {0.35, 1.25, 4.6}, .look_at = {0, 0.98, 0}, .vertical_fov = 42};
  scene.sky_distance = 60;
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.35};
  scene.medium.albedo = {0.95, 0.9, 0.8};
  scene.medium.ambient = {0.01, 0.012, 0.015};
  scene.background = {0.02, 0.03, 0.05};
  scene.lights = {point_light({-1.75, 1.75, 0.6}, {9, 5, 2}, 0.02), point_light({1.6, 2.0, -1.1}, {2, 4, 8}, 0.02)};
  Surface bunny;
  NoProgress progress;
  bunny.mesh = load_mesh("/usr/share/glmark2/models/bunny.obj", false, progress);
  bunny.transform = glm::translate(glm::dmat4(1), {0, 0.991, 0});
  bunny.material = shiny({0.62F, 0.58F, 0.52F}, 0.08F, 40);
  scene.surfaces = {bunny, floor_at(0, diffuse(0.16F, 0.17F, 0.18F))};
  return scene;
}

// Background and light are seen through finite fog; the light is a little off a pixel's centre.
Scene empty_fog_light_in_view() {
  Scene scene = foggy_scene(0.05);
  scene.sky_distance = 40;
  scene.medium.phase = {PhaseKind::mie_hazy, 0};
  scene.medium.albedo = {0.9, 0.9, 1};
  scene.background = {0.02, 0.02, 0.04};
  scene.lights = {point_light({0.43, 0.31, -5}, {10, 7, 4})};
  return scene;
}

// Rays run away from the lamp, and along the directional light; those beside the wall never end.
Scene light_behind_camera() {
  Scene scene = foggy_scene(0.3);
  scene.camera = {.position = {0.5, 1.2, 3}, .look_at = {0.3, 0.7, -1}, .vertical_fov = 60};
  scene.medium.phase = {PhaseKind::rayleigh, 0};
  scene.medium.albedo = {0.6, 0.7, 0.8};
  scene.lights = {point_light({0.2, 1.5, 4.2}, {6, 5, 4}), directional_light({-0.3, -0.5, -1}, {0.3, 0.25, 0.2})};
  scene.surfaces = {surface(box({-1, -1, -2}, {0.6, 1.1, -0.8}), shiny({0.3F, 0.5F, 0.3F}, 0.3F, 60), true),
                    floor_at(-1, diffuse(0.5F, 0.45F, 0.4F))};
  return scene;
}

// Optical depth 25 to the lamp, 35 to the nearest wall, 60 to the farthest corner.
Scene dense_fog() {
  Scene scene = foggy_scene(10);
  scene.medium.albedo = {0.99, 0.95, 0.9};
  scene.lights = {point_light({0.4, -0.2, -2.46}, {10, 20, 30})};
  Mesh wall;
  add_parallelogram(wall, {-2.5, -2.5, -3.5}, {5, 0, -1.5}, {0, 5, 0});
  scene.surfaces = {surface(std::move(wall), diffuse(0.7F, 0.6F, 0.5F), true)};
  return scene;
}

Scene hundred_thousand_triangles() {
  Scene scene = foggy_scene(0.1);
  scene.camera = {.position = {0.4, 1.6, 3.2}, .look_at = {0, -0.1, 0}};
  scene.sky_distance = 50;
  scene.medium.phase = {PhaseKind::cornette_shanks, 0.7};
  scene.medium.albedo = {0.9, 0.95, 0.7};
  scene.medium.ambient = {0.004, 0.004, 0.006};
  scene.medium.emission = {0.001, 0.0005, 0};
  scene.background = {0.02, 0.03, 0.05};
  scene.lights = {point_light({-1.5, 1.4, 0.5}, {8, 6, 4}, 0.01), point_light({1.9, 0.9, -1.5}, {2, 4, 7}),
                  directional_light({0.2, -1, -0.4}, {0.6, 0.5, 0.7})};
  Surface torus;
  torus.mesh = wavy_torus(101000);  // 317 x 158 squares: 100172 triangles
  torus.transform = glm::scale(glm::rotate(glm::dmat4(1), 0.4, {1, 0, 0.3}), {1, 1.3, 1});
  torus.material = shiny({0.25F, 0.35F, 0.5F}, 0.3F, 25);
  scene.surfaces = {floor_at(-1.1, diffuse(0.4F, 0.4F, 0.35F)), torus};
  return scene;
}

// A lamp on either side of the plume, which darkens the floor.
Scene smoke_plume() { return load_scene(AIRLIGHT_SCENES "/smoke.json"); }

constexpr TruthScene all_scenes[] = {{"gaussians_behind_box", gaussians_behind_box},
                                     {"smoke_plume", smoke_plume},
                                     {"bunny_in_fog", bunny_in_fog},
                                     {"empty_fog_light_in_view", empty_fog_light_in_view},
                                     {"light_behind_camera", light_behind_camera},
                                     {"dense_fog", dense_fog},
                                     {"hundred_thousand_triangles", hundred_thousand_triangles}};

}  // namespace

Scene gaussians_behind_box() {
  Scene scene = foggy_scene(0.08);
  scene.camera = {.position = {0.2, 0.3, 1}, .look_at = {0, 0.1, -4}, .vertical_fov = 50};
  scene.sky_distance = 12;
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.4};
  scene.medium.albedo = {0.9, 0.8, 0.7};
  scene.medium.ambient = {0.002, 0.003, 0.004};
  scene.medium.gaussians = {
      {.center = {-0.6, 0.1, -4}, .radius = 0.9, .extinction = 0.8, .albedo = {1, 0.9, 0.8}, .emission = {0.01, 0.005, 0.002}},
      {.center = {0.9, -0.3, -5}, .radius = 1.2, .extinction = 0.5, .albedo = {0.7, 0.9, 1}}};
  scene.lights = {point_light({-1.4, 2.3, -3.6}, {20, 17, 14})};
  scene.surfaces = {surface(box({-1, 0.7, -4.4}, {-0.3, 1.3, -3.5}), diffuse(0.6F, 0.4F, 0.3F), true)};
  scene.background = {0.1, 0.1, 0.2};
  return scene;
}

Scene lamp_in_gaussians() {
  Scene scene = foggy_scene(0.02);
  scene.camera = {.position = {0, 0.5, 4}, .look_at = {0, 0.2, -2}};
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.6};
  scene.medium.albedo = {0.95, 0.95, 1};
  for (std::uint32_t i = 0; i < 5; ++i) {
    Gaussian g;
    const auto number = [&](std::uint32_t k, double from, double to) { return from + (to - from) * uniform(31, 8 * i + k); };
    g.center = {number(0, -2, 2), number(1, -1, 1.5), number(2, -4, 1)};
    g.radius = number(3, 0.3, 0.9);
    g.extinction = number(4, 0.2, 3) / g.radius;
    g.albedo = {0.95, number(5, 0.6, 1), number(6, 0.6, 1)};
    if (i == 3) g.emission = {0.3, 0.15, 0.02};
    scene.medium.gaussians.push_back(g);
  }
  scene.lights = {point_light({0.4, 0.6, -1}, {4, 3, 2}), directional_light({0.4, -1, -0.3}, {1, 1, 1.2})};
  scene.background = {0.02, 0.03, 0.06};
  return scene;
}

std::span<const TruthScene> stored_scenes() { return all_scenes; }
std::span<const TruthScene> homogeneous_scenes() { return stored_scenes().subspan(2); }

}  // namespace airlight
