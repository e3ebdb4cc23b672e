#include <bit>
#include <cstring>
#include <glm/geometric.hpp>

#include "common/scene/mesh_build.h"

namespace airlight {

namespace {

constexpr std::uint32_t none = 0xFFFFFFFF;

std::uint64_t mixed(std::uint64_t h, glm::vec3 v) {
  for (int k = 0; k < 3; ++k) {
    h = (h ^ std::bit_cast<std::uint32_t>(v[k])) * 0x9E3779B97F4A7C15U;
    h ^= h >> 29U;
  }
  return h;
}

// -0 and 0 are one place.
glm::vec3 unsigned_zero(glm::vec3 v) { return v + glm::vec3(0.0F); }

bool has_area(const RawMesh& mesh, glm::uvec3 t) {
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return glm::cross(b - a, c - a) != glm::dvec3(0);
}

}  // namespace

void join_vertices(RawMesh& mesh) {
  for (glm::vec3& p : mesh.positions) p = unsigned_zero(p);
  for (glm::vec3& n : mesh.normals) n = unsigned_zero(n);
  const bool normals = !mesh.normals.empty();

  // An open hash table of new vertices; the old vertices are looked up in the order in which triangles use them.
  const std::size_t slots = std::bit_ceil(mesh.positions.size() * 2 + 1);
  std::vector<std::uint32_t> table(slots, none), renamed(mesh.positions.size(), none);
  RawMesh joined;
  const auto vertex = [&](std::uint32_t old) {
    if (renamed[old] != none) return renamed[old];
    const glm::vec3 p = mesh.positions[old];
    const glm::vec3 n = normals ? mesh.normals[old] : glm::vec3(0);
    std::size_t slot = mixed(mixed(0, p), n) & (slots - 1);
    for (; table[slot] != none; slot = (slot + 1) & (slots - 1)) {
      const std::uint32_t other = table[slot];
      if (joined.positions[other] == p && (!normals || joined.normals[other] == n)) return renamed[old] = other;
    }
    table[slot] = static_cast<std::uint32_t>(joined.positions.size());
    joined.positions.push_back(p);
    if (normals) joined.normals.push_back(n);
    return renamed[old] = table[slot];
  };
  joined.triangles.reserve(mesh.triangles.size());
  for (const glm::uvec3 t : mesh.triangles) {
    if (!has_area(mesh, t)) continue;
    const std::uint32_t a = vertex(t.x), b = vertex(t.y), c = vertex(t.z);
    joined.triangles.emplace_back(a, b, c);
  }
  mesh = std::move(joined);
}

}  // namespace airlight
