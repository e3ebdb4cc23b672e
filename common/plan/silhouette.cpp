#include "common/plan/silhouette.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/geometric.hpp>
#include <list>
#include <map>
#include <mutex>
#include <tuple>

#include "common/plan/hash.h"

namespace airlight {

namespace {

// For each vertex the first one at the same place.
std::vector<std::uint32_t> first_at_place(const std::vector<glm::vec3>& positions) {
  constexpr std::uint32_t none = 0xffffffffU;
  std::vector<std::uint32_t> table(std::bit_ceil(positions.size() * 2 + 2), none), first(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const glm::vec3 p = positions[i] + 0.0F;  // -0 and 0 are one place
    Hash hash;
    hash.add(p);
    std::size_t slot = hash.value() & (table.size() - 1);
    while (table[slot] != none && !(positions[table[slot]] == p)) slot = (slot + 1) & (table.size() - 1);
    if (table[slot] == none) table[slot] = i;
    first[i] = table[slot];
  }
  return first;
}

}  // namespace

MeshEdges::MeshEdges(const Mesh& mesh) {
  const std::vector<std::uint32_t> first = first_at_place(mesh.positions);
  corners_.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::uvec3 c(first[t.x], first[t.y], first[t.z]);
    if (c.x != c.y && c.y != c.z && c.z != c.x) corners_.push_back(c);
  }

  // Half edges by their lower vertex, then those of one vertex by the higher; the order of triangles stays.
  struct Half {
    std::uint32_t high;
    Side side;
  };
  std::vector<std::uint32_t> at(mesh.positions.size() + 1);
  const auto each_half = [&](auto&& visit) {
    for (std::uint32_t t = 0; t < corners_.size(); ++t) {
      const glm::uvec3& c = corners_[t];
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t from = c[k], to = c[(k + 1) % 3];
        visit(std::min(from, to), Half{std::max(from, to), {t, from < to ? 1 : -1}});
      }
    }
  };
  each_half([&](std::uint32_t low, const Half&) { ++at[low + 1]; });
  for (std::size_t i = 1; i < at.size(); ++i) at[i] += at[i - 1];
  const std::vector<std::uint32_t> range = at;
  std::vector<Half> halves(corners_.size() * 3);
  each_half([&](std::uint32_t low, const Half& half) { halves[at[low]++] = half; });

  sides_.reserve(halves.size());
  for (std::uint32_t low = 0; low + 1 < range.size(); ++low) {
    const auto begin = halves.begin() + range[low], end = halves.begin() + range[low + 1];
    std::sort(begin, end, [](const Half& p, const Half& q) {
      return std::tie(p.high, p.side.triangle, p.side.direction) < std::tie(q.high, q.side.triangle, q.side.direction);
    });
    for (auto half = begin; half != end; ++half) {
      if (half == begin || half->high != (half - 1)->high) {
        edges_.push_back({low, half->high});
        begin_.push_back(static_cast<std::uint32_t>(sides_.size()));
      }
      sides_.push_back(half->side);
    }
  }
  begin_.push_back(static_cast<std::uint32_t>(sides_.size()));
}

int facing(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const HomogeneousLight& light) {
  const glm::dvec3 normal = glm::cross(b - a, c - a), way = light.vector - light.point * a;
  return glm::dot(way, normal) >= 0 ? 1 : -1;
}

int beside(const glm::dvec3& light, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 n = glm::cross(a, b);
  const double volume = glm::dot(light, n);
  if (volume != 0) return volume > 0 ? 1 : -1;
  for (int c = 0; c < 3; ++c) {
    if (n[c] != 0) return n[c] > 0 ? 1 : -1;
  }
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z) ? 1 : -1;  // in one line with the camera
}

bool covers(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const HomogeneousLight& light) {
  const int side = beside(light.vector, a, b);
  if (beside(light.vector, b, c) != side || beside(light.vector, c, a) != side) return false;
  return (glm::dot(a, glm::cross(b, c)) >= 0 ? 1 : -1) == side && facing(a, b, c, light) == side;
}

std::vector<SilhouetteEdge> silhouette(const MeshEdges& mesh, std::span<const glm::dvec3> positions,
                                       const HomogeneousLight& light) {
  std::vector<std::int8_t> toward(mesh.corners().size());
  for (std::size_t t = 0; t < toward.size(); ++t) {
    const glm::uvec3& c = mesh.corners()[t];
    toward[t] = static_cast<std::int8_t>(facing(positions[c.x], positions[c.y], positions[c.z], light));
  }
  std::vector<SilhouetteEdge> found;
  for (std::size_t e = 0; e < mesh.edges().size(); ++e) {
    std::int32_t sum = 0;
    for (const MeshEdges::Side& side : mesh.sides(e)) sum += toward[side.triangle] * side.direction;
    if (sum != 0) found.push_back({mesh.edges()[e].a, mesh.edges()[e].b, sum});
  }
  return found;
}

namespace {

// What is known of the meshes that live.
class Known {
 public:
  using Silhouette = std::shared_ptr<const std::vector<SilhouetteEdge>>;

  std::shared_ptr<const MeshEdges> edges(const std::shared_ptr<const Mesh>& mesh) {
    {
      const std::lock_guard guard(lock_);
      if (const Entry* entry = find(mesh)) return entry->edges;
    }
    auto made = std::make_shared<const MeshEdges>(*mesh);  // outside the lock: two threads may do it twice
    const std::lock_guard guard(lock_);
    std::erase_if(entries_, [](const auto& item) { return item.second.mesh.expired(); });
    Entry& entry = entries_[mesh.get()];
    if (!entry.edges || entry.mesh.lock() != mesh) entry = {mesh, made, {}};
    return entry.edges;
  }

  Silhouette silhouette_of(const std::shared_ptr<const Mesh>& mesh, std::uint64_t key) {
    const std::lock_guard guard(lock_);
    Entry* entry = find(mesh);
    if (!entry) return nullptr;
    const auto found =
        std::find_if(entry->silhouettes.begin(), entry->silhouettes.end(), [&](const auto& s) { return s.first == key; });
    if (found == entry->silhouettes.end()) return nullptr;
    entry->silhouettes.splice(entry->silhouettes.begin(), entry->silhouettes, found);
    return found->second;
  }

  void keep(const std::shared_ptr<const Mesh>& mesh, std::uint64_t key, const Silhouette& silhouette) {
    const std::lock_guard guard(lock_);
    Entry* entry = find(mesh);
    if (!entry) return;
    entry->silhouettes.emplace_front(key, silhouette);
    if (entry->silhouettes.size() > most) entry->silhouettes.pop_back();
  }

 private:
  static constexpr std::size_t most = 64;  // silhouettes a mesh; the one used longest ago goes first
  struct Entry {
    std::weak_ptr<const Mesh> mesh;
    std::shared_ptr<const MeshEdges> edges;
    std::list<std::pair<std::uint64_t, Silhouette>> silhouettes;
  };
  Entry* find(const std::shared_ptr<const Mesh>& mesh) {
    const auto found = entries_.find(mesh.get());
    return found != entries_.end() && found->second.mesh.lock() == mesh ? &found->second : nullptr;
  }

  std::mutex lock_;
  std::map<const Mesh*, Entry> entries_;
};

Known& known() {
  static Known all;
  return all;
}

}  // namespace

std::shared_ptr<const MeshEdges> mesh_edges(const std::shared_ptr<const Mesh>& mesh) { return known().edges(mesh); }

std::shared_ptr<const std::vector<SilhouetteEdge>> mesh_silhouette(const std::shared_ptr<const Mesh>& mesh,
                                                                   const glm::dmat4& transform, const HomogeneousLight& light) {
  Hash hash;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) hash.add(transform[column][row]);
  }
  for (int c = 0; c < 3; ++c) hash.add(light.vector[c]);
  hash.add(light.point);
  if (auto kept = known().silhouette_of(mesh, hash.value())) return kept;

  const std::shared_ptr<const MeshEdges> edges = mesh_edges(mesh);
  std::vector<glm::dvec3> positions;
  positions.reserve(mesh->positions.size());
  for (const glm::vec3& p : mesh->positions) positions.emplace_back(transform * glm::dvec4(glm::dvec3(p), 1.0));
  auto made = std::make_shared<const std::vector<SilhouetteEdge>>(silhouette(*edges, positions, light));
  known().keep(mesh, hash.value(), made);
  return made;
}

}  // namespace airlight
