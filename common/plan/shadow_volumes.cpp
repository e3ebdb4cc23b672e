#include "common/plan/shadow_volumes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "common/plan/hash.h"

namespace airlight {

namespace {

constexpr double black = 88;  // transmittance() in common/formulas/transmittance.h is 0 from 87 on

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};

glm::dvec3 placed(const Surface& s, const glm::vec3& p) { return s.transform * glm::dvec4(glm::dvec3(p), 1.0); }

// World coordinates; the box of the mesh's own box.
Box box_of(const Surface& s) {
  glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
  for (const glm::vec3& p : s.mesh->positions) low = glm::min(low, p), high = glm::max(high, p);
  Box box;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y, (corner & 4) != 0 ? high.z : low.z);
    box.low = glm::min(box.low, placed(s, p));
    box.high = glm::max(box.high, placed(s, p));
  }
  return box;
}

// Whether the way from the origin to the light meets the box, which is taken a little larger.
bool way_meets(const Box& box, const HomogeneousLight& light) {
  const double margin = 1e-9 * (glm::length(box.low) + glm::length(box.high));
  double from = 0, to = light.point > 0 ? 1 : std::numeric_limits<double>::infinity();
  for (int c = 0; c < 3; ++c) {
    const double low = box.low[c] - margin, high = box.high[c] + margin, along = light.vector[c];
    if (along == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    from = std::max(from, std::min(low / along, high / along));
    to = std::min(to, std::max(low / along, high / along));
  }
  return from <= to * (1 + 1e-9);
}

void copy(const glm::dvec3& from, double (&to)[3]) {
  for (int c = 0; c < 3; ++c) to[c] = from[c];
}

std::int64_t covering(const Surface& s, const glm::dvec3& camera, const HomogeneousLight& light) {
  Box box = box_of(s);
  box.low -= camera;
  box.high -= camera;
  if (!way_meets(box, light)) return 0;
  std::vector<glm::dvec3> positions;
  positions.reserve(s.mesh->positions.size());
  for (const glm::vec3& p : s.mesh->positions) positions.push_back(placed(s, p) - camera);
  std::int64_t count = 0;
  for (const glm::uvec3& t : s.mesh->triangles) count += covers(positions[t.x], positions[t.y], positions[t.z], light);
  return count;
}

}  // namespace

HomogeneousLight light_near_camera(const Scene& scene, std::size_t index) {
  const LightSource& light = scene.lights.at(index);
  if (light.type == LightType::directional) return {-glm::normalize(light.direction), 0};
  return {light.position - scene.camera.position, 1};
}

bool shadow_matters(const Scene& scene, const Surface& surface, const LightSource& light) {
  if (!surface.casts_shadow || surface.mesh->triangles.empty()) return false;
  if (light.type == LightType::directional) return true;
  const double sigma = scene.medium.extinction;
  if (sigma * glm::distance(light.position, placed(surface, surface.mesh->positions[0])) <= black) return true;
  const Box box = box_of(surface);
  return !(sigma * glm::distance(light.position, glm::clamp(light.position, box.low, box.high)) > black);
}

bool behind_fog(const Scene& scene, const Surface& surface) {
  if (surface.mesh->triangles.empty() || !(scene.medium.extinction > 0)) return false;
  const glm::dvec3& camera = scene.camera.position;
  if (scene.medium.extinction * glm::distance(camera, placed(surface, surface.mesh->positions[0])) <= black) return false;
  const Box box = box_of(surface);
  return scene.medium.extinction * glm::distance(camera, glm::clamp(camera, box.low, box.high)) > black;
}

void back_to_front(std::span<ShadowEdge> edges, const ShadowLight& light) {
  const glm::dvec3 l(light.vector[0], light.vector[1], light.vector[2]);
  // Grows with the angle, and asks no library for it.
  const auto farness = [&](const ShadowEdge& e) {
    const glm::dvec3 middle = 0.5 * glm::dvec3(e.a[0] + e.b[0], e.a[1] + e.b[1], e.a[2] + e.b[2]);
    const double beside = glm::length(glm::cross(l, middle));  // |l| times the distance from the line
    if (light.point == 0) return beside;
    const double along = glm::dot(l, middle - l);
    return beside > 0 ? along / beside : std::copysign(std::numeric_limits<double>::infinity(), along);
  };
  std::vector<std::pair<double, ShadowEdge>> sorted;
  sorted.reserve(edges.size());
  for (const ShadowEdge& e : edges) sorted.emplace_back(farness(e), e);
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& p, const auto& q) { return p.first > q.first; });
  std::transform(sorted.begin(), sorted.end(), edges.begin(), [](const auto& p) { return p.second; });
}

namespace {

// visit(surface, silhouette edge): all that throw shadow planes of this light.
template <class Visit>
void each_silhouette_edge(const Scene& scene, std::size_t index, Visit&& visit) {
  const LightSource& source = scene.lights[index];
  const HomogeneousLight light = light_near_camera(scene, index);
  const HomogeneousLight in_world{light.point > 0 ? source.position : light.vector, light.point};
  for (const Surface& s : scene.surfaces) {
    if (!shadow_matters(scene, s, source)) continue;
    for (const SilhouetteEdge& e : *mesh_silhouette(s.mesh, s.transform, in_world)) visit(s, e);
  }
}

}  // namespace

std::size_t shadow_volume_bytes(const Scene& scene, const std::vector<std::size_t>& lights) {
  std::size_t edges = 0;
  for (const std::size_t index : lights) {
    each_silhouette_edge(scene, index, [&](const Surface&, const SilhouetteEdge& e) {
      edges += static_cast<std::size_t>((std::abs(e.multiplicity) + shadow_multiplicity - 1) / shadow_multiplicity);
    });
  }
  return lights.size() * sizeof(ShadowLight) + edges * sizeof(ShadowEdge);
}

ShadowVolumes shadow_volumes(const Scene& scene, const std::vector<std::size_t>& lights, ShadowOrder order) {
  ShadowVolumes volumes;
  const glm::dvec3 camera = scene.camera.position;
  for (const std::size_t index : lights) {
    const HomogeneousLight light = light_near_camera(scene, index);
    ShadowLight header{};
    copy(light.vector, header.vector);
    header.point = light.point;
    header.first = static_cast<std::int64_t>(volumes.edges.size());
    for (const Surface& s : scene.surfaces) {
      if (shadow_matters(scene, s, scene.lights[index])) header.covering += covering(s, camera, light);
    }
    each_silhouette_edge(scene, index, [&](const Surface& s, const SilhouetteEdge& e) {
      ShadowEdge edge{};
      copy(placed(s, s.mesh->positions[e.a]) - camera, edge.a);
      copy(placed(s, s.mesh->positions[e.b]) - camera, edge.b);
      for (std::int32_t rest = e.multiplicity; rest != 0; rest -= edge.multiplicity) {
        edge.multiplicity = std::clamp(rest, -shadow_multiplicity, shadow_multiplicity);
        volumes.edges.push_back(edge);
      }
    });
    header.count = static_cast<std::int64_t>(volumes.edges.size()) - header.first;
    if (order == ShadowOrder::published)
      back_to_front(std::span(volumes.edges).subspan(static_cast<std::size_t>(header.first)), header);
    volumes.lights.push_back(header);
  }
  return volumes;
}

Plan::Upload shadow_volumes_upload(const Scene& scene, const std::vector<std::size_t>& lights, ShadowOrder order,
                                   std::uint64_t geometry_key, std::uint32_t id) {
  Hash key;
  key.add(std::string_view("shadow volumes"));
  key.add(geometry_key);
  key.add(order);
  key.add(scene.medium.extinction);
  Scene kept;  // shares the meshes, so that the upload may outlive the scene
  kept.camera = scene.camera;
  kept.surfaces = scene.surfaces;
  kept.medium.extinction = scene.medium.extinction;
  for (const Surface& s : scene.surfaces) key.add(s.casts_shadow);
  std::vector<std::size_t> all(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LightSource& light = scene.lights[lights[i]];
    all[i] = i;
    kept.lights.push_back(light);
    key.add(light.type);
    const glm::dvec3 where = light.type == LightType::directional ? light.direction : light.position;
    for (int c = 0; c < 3; ++c) key.add(where[c]);
  }
  return {{{id}, 0},
          key.value(),
          [kept, all, order] {
            const ShadowVolumes volumes = shadow_volumes(kept, all, order);
            const auto header = std::as_bytes(std::span(volumes.lights)), edges = std::as_bytes(std::span(volumes.edges));
            std::vector<std::byte> bytes(header.begin(), header.end());
            bytes.insert(bytes.end(), edges.begin(), edges.end());
            return bytes;
          },
          [kept, all] { return shadow_volume_bytes(kept, all); }};
}

}  // namespace airlight
