#include "tests/parity/inputs.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/plan/shadow_volumes.h"

namespace airlight {

namespace {
constexpr double pi = std::numbers::pi;
}

double uniform(std::uint32_t stream, std::uint32_t i) {
  std::uint64_t x = (static_cast<std::uint64_t>(stream) << 32U | i) * 0x9e3779b97f4a7c15U + 0x632be59bd9b4e019U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return static_cast<double>((x ^ (x >> 31U)) >> 11U) * 0x1p-53;
}

View test_view(Extent extent) {
  View view;
  view.extent = extent;
  const double down = 0.15;
  view.forward = glm::dvec3(0, -std::sin(down), -std::cos(down));
  view.up = glm::dvec3(0, std::cos(down), -std::sin(down));
  return view;
}

TestSurfaces sphere_on_plane(const View& view, std::uint32_t first_id) {
  TestSurfaces s;
  s.distance = {{first_id}, Format::r32f, view.extent, 1, false};
  s.normal = {{first_id + 1}, Format::rgb32f, view.extent, 1, false};
  s.material = {{first_id + 2}, Format::r32f, view.extent, 1, false};
  const glm::dvec3 center(0.3, -0.4, -5);
  const double radius = 1.1, floor = -1.5;
  for (int j = 0; j < view.extent.height; ++j) {
    for (int i = 0; i < view.extent.width; ++i) {
      const double w = view.extent.width, h = view.extent.height, tan = view.tan_half_fov;
      const double x = (2 * (i + 0.5) / w - 1) * tan * w / h, y = (1 - 2 * (j + 0.5) / h) * tan;
      const glm::dvec3 d = glm::normalize(x * glm::dvec3(view.right) + y * glm::dvec3(view.up) + glm::dvec3(view.forward));
      double distance = 1e30, material = -1;
      glm::dvec3 normal(0);
      if (d.y < -1e-3) distance = floor / d.y, normal = {0, 1, 0}, material = 0;
      const double foot = glm::dot(center, d), inside = radius * radius - glm::dot(center, center) + foot * foot;
      if (inside > 0 && foot - std::sqrt(inside) < distance) {
        distance = foot - std::sqrt(inside);
        normal = (d * distance - center) / radius;
        material = 1;
      }
      s.distances.push_back(static_cast<float>(distance));
      s.materials.push_back(static_cast<float>(material));
      for (int c = 0; c < 3; ++c) s.normals.push_back(static_cast<float>(normal[c]));
    }
  }
  return s;
}

void add_to(Case& c, const TestSurfaces& s) {
  c.images.emplace_back(s.distance, s.distances);
  c.images.emplace_back(s.normal, s.normals);
  c.images.emplace_back(s.material, s.materials);
}

std::vector<Light> test_lights() {
  return {{.vector = {-1.2F, 1.1F, -4.2F}, .power = {20, 14, 8}},
          {.vector = {2.5F, 0.4F, -6.5F}, .power = {5, 9, 16}, .radius = 0.05F},
          {.vector = glm::normalize(glm::vec3(0.3F, -1, -0.2F)), .power = {0.6F, 0.6F, 0.8F}, .directional = true}};
}

std::vector<Material> test_materials() {
  return {{.diffuse = {0.5F, 0.45F, 0.4F}}, {.diffuse = {0.2F, 0.3F, 0.5F}, .specular = {0.4F, 0.4F, 0.4F}, .shininess = 40}};
}

std::shared_ptr<const Mesh> wavy_torus(std::size_t triangles) {
  const auto around = static_cast<std::uint32_t>(std::max(8.0, std::sqrt(static_cast<double>(triangles))));
  const std::uint32_t across = around / 2;
  auto mesh = std::make_shared<Mesh>();
  const auto point = [](double u, double v) {
    const double tube = 0.42 + 0.06 * std::sin(7 * u) * std::cos(5 * v);
    return glm::dvec3((1 + tube * std::cos(v)) * std::cos(u), tube * std::sin(v), (1 + tube * std::cos(v)) * std::sin(u));
  };
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = 2 * pi * i / around, v = 2 * pi * j / across, e = 1e-4;
      mesh->positions.push_back(point(u, v));
      mesh->normals.push_back(glm::normalize(glm::cross(point(u, v + e) - point(u, v - e), point(u + e, v) - point(u - e, v))));
      const std::uint32_t i1 = (i + 1) % around, j1 = (j + 1) % across;
      const std::uint32_t a = i * across + j, b = i1 * across + j, c = i1 * across + j1, d = i * across + j1;
      mesh->triangles.push_back({a, c, b});
      mesh->triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

std::shared_ptr<const Mesh> square(double half) {
  auto mesh = std::make_shared<Mesh>();
  for (const double x : {-half, half}) {
    for (const double z : {-half, half}) {
      mesh->positions.push_back(glm::dvec3(x, 0, z));
      mesh->normals.push_back({0, 1, 0});
    }
  }
  mesh->triangles = {{0, 1, 2}, {1, 3, 2}};
  return mesh;
}

Scene test_scene(std::size_t triangles) {
  Scene scene;
  scene.camera.position = {0.4, 1.6, 4};
  scene.camera.look_at = {0, 0.2, 0};
  scene.medium.extinction = 0.08;
  scene.medium.albedo = {0.95, 0.93, 0.9};
  scene.medium.ambient = {0.01, 0.01, 0.02};
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.5};
  scene.lights = {{.type = LightType::point, .name = "lamp", .position = {-1.5, 1.8, 0.5}, .power = {18, 12, 7}},
                  {.type = LightType::point, .name = "", .position = {2, 0.8, -1.5}, .power = {5, 8, 14}},
                  {.type = LightType::directional,
                   .name = "moon",
                   .direction = glm::normalize(glm::dvec3(0.2, -1, -0.4)),
                   .power = {0.3, 0.3, 0.4}}};
  Surface ground{.mesh = square(8), .material = {.diffuse = {0.4F, 0.4F, 0.35F}}};
  ground.transform[3] = {0, -0.5, 0, 1};
  const std::vector<Material> materials = test_materials();
  scene.surfaces = {ground, {.mesh = wavy_torus(triangles), .material = materials[1]}};
  scene.background = {0.02, 0.03, 0.05};
  return scene;
}

Scene lit_scene(std::shared_ptr<const Mesh> mesh, const glm::dvec3& at, double size, const std::vector<Light>& lights) {
  Scene scene = test_scene(8);
  scene.camera.position = {0, 0, 0};
  scene.lights.clear();
  for (const Light& l : lights) {
    LightSource light;
    light.type = l.directional ? LightType::directional : LightType::point;
    light.position = l.directional ? glm::dvec3(0) : glm::dvec3(l.vector);
    light.direction = l.directional ? glm::normalize(glm::dvec3(l.vector)) : glm::dvec3(0, -1, 0);
    light.power = l.power;
    light.radius = static_cast<double>(l.radius);
    scene.lights.push_back(light);
  }
  Surface caster;
  caster.mesh = std::move(mesh);
  caster.transform = glm::dmat4(size);
  caster.transform[3] = glm::dvec4(at, 1);
  scene.surfaces = {caster};
  return scene;
}

std::shared_ptr<const Mesh> slats(unsigned n) {
  auto mesh = std::make_shared<Mesh>();
  for (unsigned i = 0; i < n; ++i) {
    const float x0 = (2.0F * static_cast<float>(i) + 0.5F) / static_cast<float>(n) - 1, x1 = x0 + 1 / static_cast<float>(n);
    for (const float x : {x0, x1}) {
      for (const float z : {-1.0F, 1.0F}) mesh->positions.emplace_back(x, 0, z);
    }
    mesh->triangles.emplace_back(4 * i, 4 * i + 1, 4 * i + 2);
    mesh->triangles.emplace_back(4 * i + 1, 4 * i + 3, 4 * i + 2);
  }
  mesh->normals.assign(mesh->positions.size(), {0, 1, 0});
  return mesh;
}

Buffer add_test_volumes(Case& c, std::uint32_t id, const std::vector<Light>& lights) {
  Scene scene = lit_scene(wavy_torus(2000), {-0.4, 0.3, -4.6}, 0.5, lights);
  Surface bars = scene.surfaces[0];
  bars.mesh = slats(40);
  bars.transform = glm::dmat4(1.2);
  bars.transform[3] = {0.5, 0.9, -4.2, 1};
  scene.surfaces.push_back(bars);
  std::vector<std::size_t> index(lights.size());
  for (std::size_t i = 0; i < index.size(); ++i) index[i] = i;
  const Plan::Upload volumes = shadow_volumes_upload(scene, index, ShadowOrder::exact, 1, id);
  c.buffers.emplace_back(volumes.buffer, volumes.make());
  return volumes.buffer;
}

}  // namespace airlight
