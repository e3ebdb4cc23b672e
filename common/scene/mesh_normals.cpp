#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>
#include <utility>

#include "common/scene/mesh_build.h"

namespace airlight {

namespace {

constexpr double crease_cosine = 0.5;  // of 60 degrees

glm::dvec3 plane_normal(const RawMesh& mesh, glm::uvec3 t) {
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return glm::cross(b - a, c - a);
}

// Scaled first, so that the square of a short vector does not vanish.
glm::dvec3 unit(glm::dvec3 v) {
  v /= std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return v / std::sqrt(glm::dot(v, v));
}

bool usable(const RawMesh& mesh) {
  return !mesh.normals.empty() && std::all_of(mesh.normals.begin(), mesh.normals.end(), [](glm::vec3 n) {
    const float square = glm::dot(n, n);
    return square > 1e-12F && square < 1e12F;  // false for NaN
  });
}

Mesh flat_mesh(const RawMesh& mesh) {
  Mesh out;
  out.positions.reserve(mesh.triangles.size() * 3);
  out.normals.reserve(mesh.triangles.size() * 3);
  out.triangles.reserve(mesh.triangles.size());
  for (const glm::uvec3 t : mesh.triangles) {
    const glm::vec3 n(unit(plane_normal(mesh, t)));
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    for (int k = 0; k < 3; ++k) {
      out.positions.push_back(mesh.positions[t[k]]);
      out.normals.push_back(n);
    }
    out.triangles.emplace_back(first, first + 1, first + 2);
  }
  return out;
}

// The corners (3 * triangle + k) at every vertex: those of vertex v are at[first[v] .. first[v + 1]), in rising order.
struct Corners {
  explicit Corners(const RawMesh& mesh) : first(mesh.positions.size() + 1), at(mesh.triangles.size() * 3) {
    for (const glm::uvec3 t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) ++first[t[k] + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      for (int k = 0; k < 3; ++k)
        at[next[mesh.triangles[i][k]]++] = static_cast<std::uint32_t>(3 * i) + static_cast<std::uint32_t>(k);
    }
  }
  std::vector<std::uint32_t> first, at;
};

class Smoothing {
 public:
  explicit Smoothing(RawMesh&& mesh) : mesh_(std::move(mesh)), corners_(mesh_) {
    faces_.reserve(mesh_.triangles.size());
    for (const glm::uvec3 t : mesh_.triangles) faces_.emplace_back(unit(plane_normal(mesh_, t)));
  }

  Mesh smoothed() {
    const std::size_t vertices = mesh_.positions.size();
    out_.triangles.resize(mesh_.triangles.size());
    for (std::uint32_t v = 0; v < vertices; ++v) split(v);
    return std::move(out_);
  }

 private:
  // Groups the corners at a vertex that smooth edges connect; each group becomes a vertex of its own.
  void split(std::uint32_t v) {
    const std::span<const std::uint32_t> here(corners_.at.data() + corners_.first[v], corners_.first[v + 1] - corners_.first[v]);
    group_.resize(here.size());
    std::iota(group_.begin(), group_.end(), 0U);
    edges_.clear();
    for (std::uint32_t i = 0; i < here.size(); ++i) {
      const glm::uvec3 t = mesh_.triangles[here[i] / 3];
      const std::uint32_t k = here[i] % 3;
      edges_.emplace_back(t[static_cast<int>((k + 1) % 3)], i);
      edges_.emplace_back(t[static_cast<int>((k + 2) % 3)], i);
    }
    std::sort(edges_.begin(), edges_.end());
    for (std::size_t e = 1; e < edges_.size(); ++e) {
      const auto [end, i] = edges_[e];
      const auto [end_before, j] = edges_[e - 1];
      if (end == end_before && glm::dot(glm::dvec3(faces_[here[i] / 3]), glm::dvec3(faces_[here[j] / 3])) > crease_cosine)
        unite(i, j);
    }

    // The normal of a group weighs each face by sin(angle) / (product of its two edges): exact on a sphere (Max 1999,
    // "Weights for computing vertex normals from facet normals").
    sums_.assign(here.size(), glm::dvec3(0));
    for (std::uint32_t i = 0; i < here.size(); ++i) {
      const glm::uvec3 t = mesh_.triangles[here[i] / 3];
      const int k = static_cast<int>(here[i] % 3);
      const glm::dvec3 p(mesh_.positions[v]);
      const glm::dvec3 a = glm::dvec3(mesh_.positions[t[(k + 1) % 3]]) - p, b = glm::dvec3(mesh_.positions[t[(k + 2) % 3]]) - p;
      sums_[root(i)] += glm::cross(a, b) / (glm::dot(a, a) * glm::dot(b, b));
    }
    names_.assign(here.size(), 0);
    for (std::uint32_t i = 0; i < here.size(); ++i) {
      const std::uint32_t r = root(i);
      if (r == i) {  // the root is the group's first corner
        names_[i] = static_cast<std::uint32_t>(out_.positions.size());
        const bool vanishes = !(glm::dot(sums_[i], sums_[i]) > 0);  // opposite faces may cancel
        out_.positions.push_back(mesh_.positions[v]);
        out_.normals.push_back(vanishes ? faces_[here[i] / 3] : glm::vec3(unit(sums_[i])));
      }
      out_.triangles[here[i] / 3][static_cast<int>(here[i] % 3)] = names_[r];
    }
  }

  std::uint32_t root(std::uint32_t i) {
    while (group_[i] != i) i = group_[i] = group_[group_[i]];
    return i;
  }
  void unite(std::uint32_t i, std::uint32_t j) {
    const std::uint32_t a = root(i), b = root(j);
    group_[std::max(a, b)] = std::min(a, b);
  }

  RawMesh mesh_;
  Corners corners_;
  std::vector<glm::vec3> faces_;
  Mesh out_;
  // Of the vertex at hand: the group of each corner, (other end, corner) of each edge, sums and new names of the
  // groups.
  std::vector<std::uint32_t> group_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
  std::vector<glm::dvec3> sums_;
  std::vector<std::uint32_t> names_;
};

}  // namespace

Mesh with_normals(RawMesh&& mesh, bool flat) {
  if (flat) return flat_mesh(mesh);
  if (!usable(mesh)) {
    mesh.normals.clear();
    join_vertices(mesh);  // vertices that differed in their normals only
    return Smoothing(std::move(mesh)).smoothed();
  }
  Mesh out{std::move(mesh.positions), std::move(mesh.normals), std::move(mesh.triangles)};
  for (glm::vec3& n : out.normals) n = glm::vec3(unit(glm::dvec3(n)));
  return out;
}

}  // namespace airlight
