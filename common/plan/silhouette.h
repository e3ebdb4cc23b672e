// Silhouettes of triangle soups toward a light.
//
// Every triangle, turned to face the light, throws a volume behind it. Where two triangles meet in an edge that they run through
// in opposite ways, the sides of their volumes cancel. What is left over, edge by edge as a signed sum, bounds the count
// "triangles between a point and the light", whatever the mesh: closed, open, or with many triangles at one edge.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "common/scene/scene.h"

namespace airlight {

// Which triangles meet in which edge, vertices at the same place being one. Independent of light, camera and transform.
class MeshEdges {
 public:
  struct Edge {
    std::uint32_t a, b;  // a < b; each the first of Mesh::positions at its place
  };
  // A triangle at an edge.
  struct Side {
    std::uint32_t triangle;  // in corners()
    std::int32_t direction;  // 1 where it runs a -> b, -1 where b -> a
  };

  explicit MeshEdges(const Mesh&);

  std::span<const Edge> edges() const { return edges_; }
  std::span<const Side> sides(std::size_t edge) const {
    return std::span(sides_).subspan(begin_[edge], begin_[edge + 1] - begin_[edge]);
  }
  // Triangles, without those that have two corners at the same place: they throw no shadow.
  std::span<const glm::uvec3> corners() const { return corners_; }

 private:
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> begin_;  // of each edge's part of sides_; one more at the end
  std::vector<Side> sides_;
  std::vector<glm::uvec3> corners_;
};

// A light in homogeneous coordinates: position and 1, or unit direction toward it and 0.
struct HomogeneousLight {
  glm::dvec3 vector{0};
  double point = 1;
};

struct SilhouetteEdge {
  std::uint32_t a, b;  // vertices; seen from the light, what throws the shadow lies to the left of a -> b where multiplicity > 0
  std::int32_t multiplicity;  // not 0
};

// `positions`: of the mesh's vertices, in the frame of the light.
std::vector<SilhouetteEdge> silhouette(const MeshEdges&, std::span<const glm::dvec3> positions, const HomogeneousLight&);

// 1 where the light stands on the side from which a, b, c turn counter-clockwise; else -1.
int facing(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const HomogeneousLight&);

// Sign of det(light, a, b), positions relative to the camera: on which side of the plane of light and edge the camera stands.
// Never 0: where the determinant is, the light is moved by an infinitesimal amount, the same for every edge. beside(b, a) is the
// opposite.
int beside(const glm::dvec3& light, const glm::dvec3& a, const glm::dvec3& b);

// Whether the triangle stands between the camera (the origin) and the light, by the same signs: the number of those that do and
// the crossings of shadow planes agree even where a plane passes through the camera.
bool covers(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const HomogeneousLight&);

// The edges of a mesh, built once as long as the mesh lives. Safe from any thread.
std::shared_ptr<const MeshEdges> mesh_edges(const std::shared_ptr<const Mesh>&);

// The silhouette of a mesh where `transform` puts it; `light` in world coordinates. Kept for some lights and places of a mesh, so
// that nothing is computed for what has not moved. Safe from any thread.
std::shared_ptr<const std::vector<SilhouetteEdge>> mesh_silhouette(const std::shared_ptr<const Mesh>&,
                                                                   const glm::dmat4& transform, const HomogeneousLight& light);

}  // namespace airlight
