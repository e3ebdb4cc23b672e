#include "common/plan/geometry.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "common/error.h"
#include "common/formulas/float.h"
#include "common/plan/hash.h"

namespace airlight {

namespace {

template <class T>
void add_all(Hash& hash, const std::vector<T>& values) {
  hash.add(values.size());
  hash.bytes(std::as_bytes(std::span(values)));
}

void add_matrix(Hash& hash, const glm::dmat4& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) hash.add(m[column][row]);
  }
}

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
  const auto* p = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), p, p + sizeof value);
}

std::vector<std::byte> positions_bytes(const std::vector<Surface>& surfaces, const glm::dvec3& camera) {
  std::vector<std::byte> bytes;
  for (const Surface& s : surfaces) {
    bytes.reserve(bytes.size() + s.mesh->positions.size() * sizeof(glm::vec3));
    for (const glm::vec3& p : s.mesh->positions) {
      append(bytes, glm::vec3(glm::dvec3(s.transform * glm::dvec4(glm::dvec3(p), 1.0)) - camera));
    }
  }
  return bytes;
}

std::vector<std::byte> normals_bytes(const std::vector<Surface>& surfaces) {
  std::vector<std::byte> bytes;
  for (const Surface& s : surfaces) {
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(s.transform)));
    bytes.reserve(bytes.size() + s.mesh->normals.size() * sizeof(glm::vec3));
    for (const glm::vec3& n : s.mesh->normals) append(bytes, glm::vec3(glm::normalize(turn * glm::dvec3(n))));
  }
  return bytes;
}

std::vector<std::byte> index_bytes(const std::vector<Surface>& surfaces) {
  std::vector<std::byte> bytes;
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Mesh& mesh = *surfaces[i].mesh;
    bytes.reserve(bytes.size() + mesh.triangles.size() * 4 * sizeof(std::uint32_t));
    for (const glm::uvec3& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) append(bytes, first + t[k]);
      append(bytes, static_cast<std::uint32_t>(i));
    }
    first += static_cast<std::uint32_t>(mesh.positions.size());
  }
  return bytes;
}

}  // namespace

View view_of(const Scene& scene, const FrameRequest& request) {
  const Camera& c = scene.camera;
  const glm::dvec3 forward = glm::normalize(c.look_at - c.position);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, c.up));
  View view;
  view.forward = forward;
  view.right = right;
  view.up = glm::cross(right, forward);
  view.tan_half_fov = static_cast<float>(std::tan(glm::radians(c.vertical_fov) / 2));
  view.offset = request.offset;
  view.extent = request.extent;
  return view;
}

Light light_of(const LightSource& from, const glm::dvec3& origin) {
  Light to;
  to.directional = from.type == LightType::directional;
  to.vector = to.directional ? from.direction : from.position - origin;
  to.power = from.power;
  to.radius = static_cast<float>(from.radius);
  return to;
}

bool out_of_reach(const Scene& scene, const LightSource& light) {
  const double sigma = scene.medium.extinction;
  if (light.type == LightType::directional || !(sigma > 0)) return false;
  const double power = std::max({light.power.x, light.power.y, light.power.z});
  // The least normal float is exp(-87.3). Beside exp(-depth) stand at most: 1/r^2 at the lamp's radius; the sharpest lobe, 1600 a
  // steradian; and what a ray scatters that passes it, the extinction times pi / radius times the sharpest phase function.
  const double nearest = 1 / std::min(light.radius, 1.0);
  const double most = std::log(std::max(power, 1.0)) + 2 * std::log(nearest) + std::log(1e4 * std::max(sigma, 1.0));
  return sigma * glm::distance(light.position, scene.camera.position) > 88 + most;
}

std::vector<Light> of_unit_power(std::vector<Light> lights) {
  for (Light& light : lights) light.power = glm::vec3(1);
  return lights;
}

std::vector<Light> lights_of(const Scene& scene, std::vector<std::size_t>* index) {
  std::vector<Light> lights;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const LightSource& from = scene.lights[i];
    if (from.power == glm::dvec3(0) || out_of_reach(scene, from)) continue;
    lights.push_back(light_of(from, scene.camera.position));
    if (index) index->push_back(i);
  }
  return lights;
}

std::vector<Material> materials_of(const Scene& scene) {
  std::vector<Material> materials;
  for (const Surface& s : scene.surfaces) materials.push_back(s.material);
  if (materials.empty()) materials.emplace_back();
  return materials;
}

std::vector<GaussianDensity> gaussians_of(const Scene& scene) { return gaussians_of(scene, scene.camera.position); }

float gaussian_reach(const Gaussian& g, double lost_depth) {
  const double whole = g.extinction * g.radius * std::sqrt(std::numbers::pi);
  const f32::Float radii = f32::sqrt(f32::log_(std::max(whole, 1.0) / lost_depth));
  return static_cast<float>(g.radius) * radii.v;
}

std::vector<GaussianDensity> gaussians_of(const Scene& scene, const glm::dvec3& origin, double lost_depth) {
  std::vector<GaussianDensity> gaussians;
  for (const Gaussian& from : scene.medium.gaussians) {
    if (!(from.extinction > 0)) continue;
    GaussianDensity to;
    to.center = from.center - origin;
    to.radius = static_cast<float>(from.radius);
    to.extinction = static_cast<float>(from.extinction);
    to.albedo = from.albedo;
    to.emission = from.emission;
    const auto farthest = static_cast<double>(gaussian_reach(from, least_lost_depth));
    const bool lamp = std::any_of(scene.lights.begin(), scene.lights.end(), [&](const LightSource& l) {
      return l.type == LightType::point && l.power != glm::dvec3(0) &&
             glm::dot(l.position - from.center, l.position - from.center) < farthest * farthest;
    });
    to.reach = gaussian_reach(from, lamp ? least_lost_depth : lost_depth);
    gaussians.push_back(to);
  }
  return gaussians;
}

Geometry geometry_of(const Scene& scene, std::uint32_t first_id) {
  Geometry g;
  Hash places, directions, indices;
  for (int c = 0; c < 3; ++c) places.add(scene.camera.position[c]);
  for (const Surface& s : scene.surfaces) {
    g.vertices += s.mesh->positions.size();
    g.triangles += s.mesh->triangles.size();
    add_matrix(places, s.transform);
    add_matrix(directions, s.transform);
    add_all(places, s.mesh->positions);
    add_all(directions, s.mesh->normals);
    indices.add(s.mesh->positions.size());  // on which the numbers of the next surface's vertices depend
    add_all(indices, s.mesh->triangles);
  }
  if (g.triangles * 3 >= (std::size_t{1} << 31U)) throw InputError("the surfaces have more than 2^31 indices in all");
  const std::vector<Surface>& surfaces = scene.surfaces;  // shares the meshes, so that the uploads may outlive the scene
  g.positions = {{{first_id}, g.vertices * sizeof(glm::vec3)}, places.value(), [surfaces, camera = scene.camera.position] {
                   return positions_bytes(surfaces, camera);
                 }};
  g.normals = {
      {{first_id + 1}, g.vertices * sizeof(glm::vec3)}, directions.value(), [surfaces] { return normals_bytes(surfaces); }};
  g.indices = {
      {{first_id + 2}, g.triangles * 4 * sizeof(std::uint32_t)}, indices.value(), [surfaces] { return index_bytes(surfaces); }};
  return g;
}

}  // namespace airlight
