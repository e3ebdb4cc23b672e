// Scenes of the truth tests, built in code.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "common/scene/scene.h"

namespace airlight {

inline LightSource point_light(const glm::dvec3& position, const glm::dvec3& intensity, double radius = 1e-3) {
  LightSource l;
  l.position = position;
  l.power = intensity;
  l.radius = radius;
  return l;
}

inline LightSource directional_light(const glm::dvec3& direction, const glm::dvec3& irradiance) {
  LightSource l;
  l.type = LightType::directional;
  l.direction = glm::normalize(direction);
  l.power = irradiance;
  return l;
}

// A parallelogram with corner `corner`, flat normal.
inline void add_parallelogram(Mesh& mesh, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
  const auto first = static_cast<unsigned>(mesh.positions.size());
  const glm::vec3 normal = glm::normalize(glm::cross(u, v));
  for (const glm::dvec3& p : {corner, corner + u, corner + u + v, corner + v}) {
    mesh.positions.emplace_back(p);
    mesh.normals.push_back(normal);
  }
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.triangles.emplace_back(first, first + 2, first + 3);
}

inline Surface surface(Mesh mesh, const Material& material, bool casts_shadow) {
  Surface s;
  s.mesh = std::make_shared<const Mesh>(std::move(mesh));
  s.material = material;
  s.casts_shadow = casts_shadow;
  return s;
}

inline Material diffuse(float r, float g, float b) {
  Material m;
  m.diffuse = {r, g, b};
  return m;
}

inline Mesh box(const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 s = high - low;
  const glm::dvec3 x(s.x, 0, 0), y(0, s.y, 0), z(0, 0, s.z);
  Mesh mesh;
  add_parallelogram(mesh, low, y, x);
  add_parallelogram(mesh, low, x, z);
  add_parallelogram(mesh, low, z, y);
  add_parallelogram(mesh, high, -x, -y);
  add_parallelogram(mesh, high, -z, -x);
  add_parallelogram(mesh, high, -y, -z);
  return mesh;
}

// A wall across the view at z, far wider than the picture.
inline Surface black_wall(double z) {
  Mesh mesh;
  add_parallelogram(mesh, {-100, -100, z}, {200, 0, 0}, {0, 200, 0});
  return surface(std::move(mesh), diffuse(0, 0, 0), false);
}

// Camera at the origin looking along -z, 45 degrees, in homogeneous fog of this extinction.
inline Scene foggy_scene(double extinction) {
  Scene scene;
  scene.medium.extinction = extinction;
  return scene;
}

// The ray through the centre of the only pixel of this extent is the camera's axis.
inline constexpr Extent one_pixel{1, 1};
inline constexpr glm::dvec2 centre{0.5, 0.5};

}  // namespace airlight
