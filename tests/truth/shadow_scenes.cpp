#include "tests/truth/shadow_scenes.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "common/scene/load.h"
#include "tests/parity/inputs.h"
#include "tests/truth/scenes.h"

namespace airlight {

namespace {

Surface wide_floor(double y, double half, const Material& material) {
  Mesh mesh;
  add_parallelogram(mesh, {-half, y, half}, {2 * half, 0, 0}, {0, 0, -2 * half});
  return surface(std::move(mesh), material, true);
}

void append(Mesh& mesh, const Mesh& more) {
  const auto first = static_cast<unsigned>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  mesh.normals.insert(mesh.normals.end(), more.normals.begin(), more.normals.end());
  for (const glm::uvec3& t : more.triangles) mesh.triangles.push_back(t + first);
}

Scene bunny_under_one_lamp() {
  Scene scene = foggy_scene(0.15);
  scene.camera = {.position = {0.5, 1.3, 4.2}, .look_at = {0, 0.95, 0}, .vertical_fov = 42};
  scene.sky_distance = 40;
  scene.medium.albedo = {0.95, 0.93, 0.9};
  scene.lights = {point_light({-0.3, 3.1, -0.4}, {20, 17, 12}, 0.01)};
  Surface bunny;
  NoProgress progress;
  bunny.mesh = load_mesh("/usr/share/glmark2/models/bunny.obj", false, progress);
  bunny.transform = glm::translate(glm::dmat4(1), {0, 0.991, 0});
  bunny.material = {.diffuse = {0.62F, 0.58F, 0.52F}};
  scene.surfaces = {bunny, wide_floor(0, 8, diffuse(0.3F, 0.3F, 0.3F))};
  return scene;
}

// A lamp in a cage of 6 x 2 x 7 bars: some hundred thin shafts that interleave.
Scene lattice_cage() {
  Scene scene = foggy_scene(0.12);
  scene.camera = {.position = {0.87, 1.05, 4.6}, .look_at = {0, 0.1, 0}, .vertical_fov = 50};
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.3};
  scene.sky_distance = 30;
  scene.lights = {point_light({0.03, 0.02, -0.05}, {8, 7, 5})};
  Mesh cage;
  const double half = 0.8, thick = 0.03;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double at = face % 2 == 0 ? -half : half;
    for (int way = 0; way < 2; ++way) {
      const int along = (axis + 1 + way) % 3, across = (axis + 2 - way) % 3;
      for (int bar = 0; bar < 7; ++bar) {
        glm::dvec3 low, high;
        low[axis] = at - thick * (way + 1), high[axis] = at + thick * (way + 1);
        low[along] = -half - 0.1, high[along] = half + 0.1;
        const double middle = -half + bar * (2 * half / 6);
        low[across] = middle - thick, high[across] = middle + thick;
        append(cage, box(low, high));
      }
    }
  }
  scene.surfaces = {surface(std::move(cage), diffuse(0.05F, 0.045F, 0.04F), true),
                    wide_floor(-1.2, 8, diffuse(0.4F, 0.4F, 0.4F))};
  return scene;
}

// The camera stands behind a wall with two windows, deep in its shadow, and sees the shafts through them from the side.
Scene camera_in_shadow() {
  Scene scene = foggy_scene(0.1);
  scene.camera = {.position = {0.2, 0.4, 1.5}, .look_at = {0.1, 0.3, -3}, .vertical_fov = 65};
  scene.medium.phase = {PhaseKind::mie_hazy, 0};
  scene.sky_distance = 25;
  scene.lights = {point_light({-0.6, 2.6, 5.5}, {60, 50, 40})};
  Mesh wall;
  for (const auto& [x0, x1, y0, y1] : {std::array{-6.0, -1.2, -1.0, 5.0},
                                       {-0.8, 0.9, -1.0, 5.0},
                                       {1.4, 6.0, -1.0, 5.0},
                                       {-1.2, -0.8, -1.0, 0.9},
                                       {-1.2, -0.8, 1.9, 5.0},
                                       {0.9, 1.4, -1.0, 0.9},
                                       {0.9, 1.4, 1.9, 5.0}}) {
    add_parallelogram(wall, {x0, y0, 2.4}, {x1 - x0, 0, 0}, {0, y1 - y0, 0});
  }
  scene.surfaces = {surface(std::move(wall), diffuse(0.5F, 0.5F, 0.5F), true), wide_floor(-1, 9, diffuse(0.5F, 0.45F, 0.4F))};
  return scene;
}

Scene light_behind_camera() {
  Scene scene = foggy_scene(0.2);
  scene.camera = {.position = {0.5, 1.2, 3}, .look_at = {0.3, 0.7, -1}, .vertical_fov = 60};
  scene.medium.phase = {PhaseKind::rayleigh, 0};
  scene.medium.albedo = {0.6, 0.7, 0.8};
  scene.lights = {point_light({0.2, 1.5, 4.6}, {12, 10, 8})};
  Mesh things = box({-1, -1, -2}, {0.6, 1.1, -0.8});
  append(things, box({0.25, 1.25, 3.6}, {0.5, 1.4, 3.7}));  // behind the camera too
  append(things, box({1.2, -0.4, 0.8}, {1.5, 1.9, 1.1}));
  scene.surfaces = {surface(std::move(things), diffuse(0.3F, 0.5F, 0.3F), true), wide_floor(-1, 8, diffuse(0.5F, 0.45F, 0.4F))};
  return scene;
}

// Five sides of a box, the lamp within: light leaves through the sixth alone.
Scene light_in_open_box() {
  Scene scene = foggy_scene(0.15);
  scene.camera = {.position = {1.9, 1.1, 3.4}, .look_at = {0.3, 0.1, 0}, .vertical_fov = 50};
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.5};
  scene.sky_distance = 30;
  scene.lights = {point_light({-0.1, 0.05, -0.1}, {15, 12, 8})};
  Mesh sides;
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), low(-0.5, -0.5, -0.5), high(0.5, 0.5, 0.5);
  add_parallelogram(sides, low, y, x);
  add_parallelogram(sides, low, x, z);
  add_parallelogram(sides, low, z, y);
  add_parallelogram(sides, high, -x, -y);
  add_parallelogram(sides, high, -z, -x);
  Surface open = surface(std::move(sides), diffuse(0.6F, 0.55F, 0.5F), true);
  open.transform = glm::rotate(glm::dmat4(1), 0.35, {0.3, 1, 0.2});
  scene.surfaces = {open, wide_floor(-1, 8, diffuse(0.4F, 0.4F, 0.4F))};
  return scene;
}

// A torn sheet: waves, with every fifth square missing, and one triangle three of which meet in an edge.
Scene open_mesh() {
  Scene scene = foggy_scene(0.12);
  scene.camera = {.position = {0.3, 0.6, 3.6}, .look_at = {0, 0, 0}, .vertical_fov = 48};
  scene.sky_distance = 30;
  scene.lights = {point_light({0.4, 2.2, -0.6}, {14, 12, 10})};
  Mesh sheet;
  constexpr int n = 16;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double x = 3.0 * i / n - 1.5, z = 3.0 * j / n - 1.5;
      sheet.positions.emplace_back(x, 0.5 + 0.15 * std::sin(4 * x) * std::cos(3 * z), z);
      sheet.normals.emplace_back(0, 1, 0);
    }
  }
  for (unsigned i = 0; i < n; ++i) {
    for (unsigned j = 0; j < n; ++j) {
      if ((3 * i + j) % 5 == 0) continue;
      const unsigned a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
      // Neighbours are turned one up and one down: a file may hold anything.
      if ((i + j) % 2 == 0) {
        sheet.triangles.emplace_back(a, b, c), sheet.triangles.emplace_back(b, d, c);
      } else {
        sheet.triangles.emplace_back(a, c, b), sheet.triangles.emplace_back(b, c, d);
      }
    }
  }
  const auto fin = static_cast<unsigned>(sheet.positions.size());
  sheet.positions.emplace_back(0.1, 1.1, 0.1);
  sheet.normals.emplace_back(0, 1, 0);
  sheet.triangles.emplace_back(8U * (n + 1) + 8, 8U * (n + 1) + 9, fin);
  sheet.triangles.emplace_back(8U * (n + 1) + 9, 9U * (n + 1) + 9, fin);
  Mesh flat;  // every triangle with its own flat normals, so that the light's side is one and the same for face and normal
  for (const glm::uvec3& t : sheet.triangles) {
    const auto first = static_cast<unsigned>(flat.positions.size());
    const glm::vec3 a = sheet.positions[t.x], b = sheet.positions[t.y], c = sheet.positions[t.z];
    flat.positions.insert(flat.positions.end(), {a, b, c});
    flat.normals.insert(flat.normals.end(), 3, glm::normalize(glm::cross(b - a, c - a)));
    flat.triangles.emplace_back(first, first + 1, first + 2);
  }
  scene.surfaces = {surface(std::move(flat), diffuse(0.5F, 0.5F, 0.6F), true), wide_floor(-1, 8, diffuse(0.4F, 0.4F, 0.35F))};
  return scene;
}

Scene lamp_and_sun() {
  Scene scene = foggy_scene(0.1);
  scene.camera = {.position = {-0.6, 1.5, 4.2}, .look_at = {0, 0.2, 0}, .vertical_fov = 50};
  scene.medium.phase = {PhaseKind::cornette_shanks, 0.6};
  scene.medium.albedo = {0.9, 0.95, 1};
  scene.medium.ambient = {0.004, 0.005, 0.008};
  scene.sky_distance = 40;
  scene.lights = {point_light({1.5, 1.3, -0.8}, {10, 8, 5}), directional_light({0.6, -0.7, -0.35}, {0.8, 0.75, 0.6})};
  Surface torus;
  torus.mesh = wavy_torus(3000);
  torus.transform = glm::rotate(glm::dmat4(1), 1.1, {1, 0.2, 0.3});
  torus.material = {.diffuse = {0.5F, 0.3F, 0.2F}, .specular = glm::vec3(0.2F), .shininess = 30};
  scene.surfaces = {torus, surface(box({-2.2, -1, -1.8}, {-1.6, 1.4, -1.2}), diffuse(0.4F, 0.4F, 0.5F), true),
                    wide_floor(-1, 9, diffuse(0.4F, 0.4F, 0.35F))};
  return scene;
}

// 92 x 92 houses of 12 triangles: 101 568. A low sun, and two street lamps.
Scene city_at_dusk() {
  Scene scene = foggy_scene(0.006);
  scene.camera = {.position = {3.01, 48, 90}, .look_at = {0, 3, 48}, .vertical_fov = 34};
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.6};
  scene.medium.ambient = {0.002, 0.002, 0.004};
  scene.sky_distance = 2000;
  scene.background = {0.05, 0.03, 0.03};
  scene.lights = {directional_light({0.75, -0.22, 0.45}, {1.2, 0.7, 0.4}), point_light({2, 6, 70}, {300, 250, 150}, 0.05),
                  point_light({-27, 5, 35}, {300, 260, 160}, 0.05)};
  Mesh houses;
  constexpr std::uint32_t n = 92;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t k = i * n + j;
      const double x = (i - (n - 1) / 2.0) * 4 + (i / 6 - 7.0) * 3, z = (j - (n - 1) / 2.0) * 4 + (j / 6 - 7.0) * 3;
      const double w = 1.2 + 0.7 * uniform(31, k), d = 1.2 + 0.7 * uniform(32, k);
      const double h = 2 + 5 * uniform(33, k) + 18 * std::pow(uniform(34, k), 8);
      append(houses, box({x - w, 0, z - d}, {x + w, h, z + d}));
    }
  }
  scene.surfaces = {surface(std::move(houses), diffuse(0.45F, 0.4F, 0.38F), true),
                    wide_floor(-0.02, 400, diffuse(0.2F, 0.2F, 0.2F))};
  return scene;
}

}  // namespace

std::span<const TruthScene> shadow_scenes() {
  static constexpr TruthScene scenes[] = {{"bunny_under_one_lamp", bunny_under_one_lamp},
                                          {"lattice_cage", lattice_cage},
                                          {"camera_in_shadow", camera_in_shadow},
                                          {"shadows_of_light_behind_camera", light_behind_camera},
                                          {"light_in_open_box", light_in_open_box},
                                          {"open_mesh", open_mesh},
                                          {"lamp_and_sun", lamp_and_sun},
                                          {"city_at_dusk", city_at_dusk}};
  return scenes;
}

}  // namespace airlight
