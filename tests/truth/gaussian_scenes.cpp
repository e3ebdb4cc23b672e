#include "tests/truth/gaussian_scenes.h"

#include <cmath>
#include <numbers>

#include "tests/parity/inputs.h"
#include "tests/truth/scenes.h"

namespace airlight {

namespace {

// The i-th number of a scene, in from..to.
class Numbers {
 public:
  explicit Numbers(std::uint32_t stream) : stream_(stream) {}
  double operator()(double from, double to) { return from + (to - from) * uniform(stream_, next_++); }

 private:
  std::uint32_t stream_, next_ = 0;
};

Scene blobs(double extinction, glm::dvec3 position, glm::dvec3 look_at) {
  Scene scene = foggy_scene(extinction);
  scene.camera = {.position = position, .look_at = look_at, .vertical_fov = 50};
  scene.sky_distance = 60;
  return scene;
}

// Optical depth 2.7 through its centre.
Scene one_blob() {
  Scene scene = blobs(0, {0, 0, 5}, {0, 0, 0});
  scene.medium.gaussians = {{.center = {0.1, 0, 0}, .radius = 1, .extinction = 2.7 / std::sqrt(std::numbers::pi)}};
  scene.lights = {point_light({2.2, 1.6, 1.1}, {10, 9, 8})};
  return scene;
}

void add_eight_blobs(Scene& scene) {
  Numbers number(801);
  for (int i = 0; i < 8; ++i) {
    const double x = number(-3, 3), y = number(-2, 2), z = number(-5, 0), radius = number(0.4, 1);
    scene.medium.gaussians.push_back({.center = {x, y, z},
                                      .radius = radius,
                                      .extinction = number(0.6, 2.2) / radius,
                                      .albedo = {0.95, number(0.7, 1), number(0.7, 1)}});
  }
}

Scene eight_blobs() {
  Scene scene = blobs(0, {0, 0.3, 5}, {0, 0, -2});
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.5};
  add_eight_blobs(scene);
  scene.lights = {point_light({-2.5, 2.5, 1}, {20, 18, 15}), point_light({2, -1.5, -1}, {5, 7, 10})};
  scene.background = {0.02, 0.03, 0.05};
  return scene;
}

Scene blobs_in_fog() {
  Scene scene = eight_blobs();
  scene.medium.extinction = 0.05;
  scene.medium.albedo = {0.9, 0.9, 1};
  scene.medium.emission = {0.0005, 0.0003, 0};
  return scene;
}

// Mist in a valley.
Scene valley() {
  Scene scene = blobs(0.004, {0, 4.5, 16}, {0, 0.5, 0});
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.3};
  const auto height = [](double x, double z) {
    return 0.045 * x * x + 0.5 * std::sin(0.9 * x + 0.3 * z) * std::cos(0.5 * z) - 0.6;
  };
  Mesh terrain;
  constexpr int cells = 40;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const double x = -16 + 32.0 * i / cells, z = -26 + 40.0 * j / cells, step = 1e-3;
      terrain.positions.emplace_back(x, height(x, z), z);
      terrain.normals.push_back(glm::normalize(
          glm::vec3(-(height(x + step, z) - height(x, z)) / step, 1, -(height(x, z + step) - height(x, z)) / step)));
    }
  }
  for (unsigned j = 0; j < cells; ++j) {
    for (unsigned i = 0; i < cells; ++i) {
      const unsigned k = j * (cells + 1) + i;
      terrain.triangles.emplace_back(k, k + cells + 1, k + 1);
      terrain.triangles.emplace_back(k + 1, k + cells + 1, k + cells + 2);
    }
  }
  scene.surfaces = {surface(std::move(terrain), diffuse(0.3F, 0.35F, 0.2F), false)};
  Numbers number(802);
  for (int i = 0; i < 300; ++i) {
    const double x = number(-6, 6), z = number(-18, 9), radius = number(0.5, 1.3);
    scene.medium.gaussians.push_back(
        {.center = {x, height(x, z) + number(0, 1.2), z}, .radius = radius, .extinction = number(0.02, 0.2) / radius});
  }
  scene.lights = {directional_light({0.6, -0.5, -0.4}, {1.2, 1.1, 0.9}), point_light({-1.5, 1.2, 3}, {8, 6, 4})};
  scene.background = {0.25, 0.3, 0.4};
  return scene;
}

Scene steam_in_box() {
  Scene scene = blobs(0, {0.4, 1.4, 5.2}, {0, 1, 0});
  Mesh walls;
  add_parallelogram(walls, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  add_parallelogram(walls, {-2, 0, -2}, {4, 0, 0}, {0, 2.5, 0});
  add_parallelogram(walls, {-2, 0, 2}, {0, 0, -4}, {0, 2.5, 0});
  scene.surfaces = {surface(std::move(walls), diffuse(0.5F, 0.45F, 0.4F), false)};
  Numbers number(803);
  for (int i = 0; i < 3000; ++i) {
    const double up = number(0, 1), wide = 0.25 + 0.9 * up, angle = number(0, 2 * std::numbers::pi);
    const double off = wide * std::sqrt(number(0, 1));
    scene.medium.gaussians.push_back({.center = {off * std::cos(angle), 0.1 + 2.1 * up, off * std::sin(angle)},
                                      .radius = number(0.1, 0.22),
                                      .extinction = number(0.02, 0.12)});
  }
  scene.lights = {point_light({1.5, 2.2, 1.2}, {6, 5.5, 5})};
  return scene;
}

Scene light_in_blob() {
  Scene scene = eight_blobs();
  scene.lights = {point_light(scene.medium.gaussians[2].center + glm::dvec3(0.1, 0.05, -0.1), {4, 4, 3})};
  return scene;
}

Scene camera_in_blob() {
  Scene scene = eight_blobs();
  scene.camera.position = scene.medium.gaussians[4].center + glm::dvec3(0.2, 0.1, 0.3);
  scene.camera.look_at = {0, 0, -2.5};
  return scene;
}

// What lies behind the camera is not seen, but it shades.
Scene blobs_behind_camera() {
  Scene scene = blobs(0.03, {0, 0, 0}, {0, 0, -4});
  scene.medium.gaussians = {{.center = {0.2, 1, 3}, .radius = 0.8, .extinction = 2},
                            {.center = {-1, -0.4, 2}, .radius = 0.6, .extinction = 3},
                            {.center = {0.5, 0.2, -4}, .radius = 1, .extinction = 0.4}};
  scene.lights = {point_light({0.4, 1.6, 5}, {40, 38, 35}), directional_light({0.1, -0.2, -1}, {0.3, 0.3, 0.4})};
  Mesh wall;
  add_parallelogram(wall, {-5, -4, -7}, {10, 0, 0}, {0, 8, 0});
  scene.surfaces = {surface(std::move(wall), diffuse(0.6F, 0.6F, 0.6F), false)};
  return scene;
}

// Figure 7, left: halos close to a light in thin, wide blobs.
Scene halo() {
  Scene scene = blobs(0, {0, 0, 6}, {0, 0, 0});
  scene.medium.gaussians = {{.center = {-0.4, 0.1, 0}, .radius = 2.4, .extinction = 0.12},
                            {.center = {0.9, -0.3, -0.6}, .radius = 1.8, .extinction = 0.1}};
  scene.lights = {point_light({0.3, 0.25, 0.2}, {2, 1.8, 1.5}), point_light({-1.1, -0.6, 0.5}, {0.8, 1, 1.4})};
  return scene;
}

// Figure 7, right: a tube of cloud with a hole, through which a lamp behind it shines.
Scene pierced_tube() {
  Scene scene = blobs(0, {0, 0.4, 6}, {0, 0, 0});
  for (int ring = 0; ring < 5; ++ring) {
    for (int i = 0; i < 14; ++i) {
      const double angle = 2 * std::numbers::pi * i / 14;
      if (ring == 2 && i < 3) continue;
      scene.medium.gaussians.push_back(
          {.center = {0.55 * (ring - 2), 1.1 * std::cos(angle), 1.1 * std::sin(angle)}, .radius = 0.4, .extinction = 3.5});
    }
  }
  scene.lights = {point_light({0, 0, 0}, {12, 11, 9})};
  return scene;
}

// A lamp behind slats: shafts through five Gaussians in thin fog, and on the floor beneath them.
Scene shafts_through_blobs() {
  Scene scene = blobs(0.03, {0.6, 0.7, 5}, {0, -0.1, -1});
  scene.sky_distance = 25;
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.3};
  scene.medium.gaussians = {{.center = {-1.2, 0.2, -1}, .radius = 0.8, .extinction = 0.7, .albedo = {1, 0.9, 0.8}},
                            {.center = {0.1, -0.3, -0.6}, .radius = 0.7, .extinction = 0.9},
                            {.center = {1.3, 0.3, -1.4}, .radius = 0.9, .extinction = 0.6, .albedo = {0.8, 0.9, 1}},
                            {.center = {0.3, 0.5, -2.5}, .radius = 1.1, .extinction = 0.3, .emission = {0.002, 0.001, 0}},
                            {.center = {-0.3, 2.1, -0.9}, .radius = 0.4, .extinction = 0.8}};
  scene.lights = {point_light({0.2, 3.3, -1.1}, {25, 22, 17}), directional_light({0.5, -1, -0.3}, {0.3, 0.35, 0.5})};
  Mesh slats, floor;
  for (int i = 0; i < 6; ++i) add_parallelogram(slats, {-1.35 + 0.5 * i, 1.5, -2.4}, {0.27, 0.02 * i, 0}, {0, 0, 2.7});
  add_parallelogram(floor, {-5, -1.3, 3}, {10, 0, 0}, {0, 0, -8});
  scene.surfaces = {surface(std::move(slats), diffuse(0.4F, 0.3F, 0.2F), true),
                    surface(std::move(floor), diffuse(0.4F, 0.4F, 0.4F), true)};
  scene.background = {0.02, 0.03, 0.05};
  return scene;
}

// A box within a Gaussian, between the lamps on either side of it; no fog.
Scene box_in_blob() {
  Scene scene = blobs(0, {0.3, 0.5, 4.5}, {0, 0, 0});
  scene.medium.gaussians = {{.center = {0, 0, 0}, .radius = 1.2, .extinction = 0.9, .albedo = {0.95, 0.9, 0.85}},
                            {.center = {0.9, 0.6, 0.3}, .radius = 0.5, .extinction = 1.2}};
  scene.lights = {point_light({-1.7, 1.3, 0.4}, {12, 10, 7}), point_light({0.7, 0.1, -1.1}, {2, 3, 5})};
  scene.surfaces = {surface(box({-0.45, -0.35, -0.3}, {0.25, 0.4, 0.35}), diffuse(0.5F, 0.5F, 0.45F), true)};
  return scene;
}

constexpr TruthScene scenes[] = {{"one_blob", one_blob},
                                 {"eight_blobs", eight_blobs},
                                 {"valley", valley},
                                 {"steam_in_box", steam_in_box},
                                 {"blobs_in_fog", blobs_in_fog},
                                 {"light_in_blob", light_in_blob},
                                 {"camera_in_blob", camera_in_blob},
                                 {"blobs_behind_camera", blobs_behind_camera},
                                 {"halo", halo},
                                 {"pierced_tube", pierced_tube},
                                 {"lamp_in_gaussians", lamp_in_gaussians},
                                 {"gaussians_behind_box", gaussians_behind_box},
                                 {"shafts_through_blobs", shafts_through_blobs},
                                 {"box_in_blob", box_in_blob}};

}  // namespace

std::span<const TruthScene> gaussian_scenes() { return scenes; }

}  // namespace airlight
