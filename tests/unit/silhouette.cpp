// Silhouettes of triangle soups and the planes that they throw: exact properties in double.
#include "common/plan/silhouette.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "tests/parity/inputs.h"

namespace airlight {

namespace {

glm::dvec3 random_point(std::uint32_t stream, std::uint32_t i, double reach) {
  return reach * (2.0 * glm::dvec3(uniform(stream, 3 * i), uniform(stream, 3 * i + 1), uniform(stream, 3 * i + 2)) - 1.0);
}

std::vector<glm::dvec3> in_double(const Mesh& mesh) { return {mesh.positions.begin(), mesh.positions.end()}; }

// A cube whose faces have vertices of their own, as meshes with flat normals do.
Mesh cube() {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const auto first = static_cast<unsigned>(mesh.positions.size());
      for (int k = 0; k < 4; ++k) {
        glm::vec3 p;
        p[axis] = side == 0 ? -0.5F : 0.5F;
        p[(axis + 1) % 3] = (k == 1 || k == 2) == (side == 1) ? 0.5F : -0.5F;
        p[(axis + 2) % 3] = k >= 2 ? 0.5F : -0.5F;
        mesh.positions.push_back(p);
      }
      mesh.triangles.emplace_back(first, first + 1, first + 2);
      mesh.triangles.emplace_back(first, first + 2, first + 3);
    }
  }
  mesh.normals.assign(mesh.positions.size(), {0, 1, 0});
  return mesh;
}

// `count` triangles with corners drawn from few points, so that many share an edge, some of them twice over and some without
// area.
Mesh soup(std::uint32_t stream, unsigned count) {
  Mesh mesh;
  for (unsigned i = 0; i < 12; ++i) mesh.positions.emplace_back(random_point(stream, i, 1));
  for (unsigned i = 0; i < count; ++i) {
    const auto corner = [&](unsigned k) { return static_cast<unsigned>(12 * uniform(stream + 1000, 3 * i + k)); };
    mesh.triangles.emplace_back(corner(0), corner(1), corner(2));
  }
  mesh.normals.assign(mesh.positions.size(), {0, 1, 0});
  return mesh;
}

std::map<std::uint32_t, int> balance(const std::vector<SilhouetteEdge>& edges) {
  std::map<std::uint32_t, int> sum;
  for (const SilhouetteEdge& e : edges) sum[e.a] += e.multiplicity, sum[e.b] -= e.multiplicity;
  return sum;
}

// How many triangles the segment from p to the light crosses.
int between(const Mesh& mesh, const glm::dvec3& p, const HomogeneousLight& light) {
  int count = 0;
  const glm::dvec3 way = light.vector - light.point * p;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double slope = glm::dot(n, way);
    if (slope == 0) continue;
    const double s = glm::dot(n, a - p) / slope;
    if (s <= 0 || (light.point > 0 && s >= 1)) continue;
    const glm::dvec3 x = p + s * way;
    const double u = glm::dot(n, glm::cross(b - a, x - a)), v = glm::dot(n, glm::cross(c - b, x - b)),
                 w = glm::dot(n, glm::cross(a - c, x - c));
    count += u > 0 && v > 0 && w > 0;
  }
  return count;
}

// Signed crossings of p + t d, 0 < t < end, with the planes that the edges throw, and with the triangles themselves: crossing one
// puts it between the traveller and the light, or takes it away.
int crossings(const Mesh& mesh, const std::vector<SilhouetteEdge>& edges, const glm::dvec3& p, const glm::dvec3& d, double end,
              const HomogeneousLight& light) {
  int sum = 0;
  for (const SilhouetteEdge& e : edges) {
    const glm::dvec3 a(mesh.positions[e.a]), b(mesh.positions[e.b]);
    const glm::dvec3 n = glm::cross(b - a, light.vector - light.point * a);  // away from the left of a -> b, as the light sees it
    const double slope = glm::dot(n, d);
    if (slope == 0) continue;
    const double t = glm::dot(n, a - p) / slope;
    if (t <= 0 || t >= end) continue;
    const glm::dvec3 x = p + t * d;
    // x - light = alpha (a - light) + beta (b - light), alpha, beta >= 0, alpha + beta >= 1.
    const glm::dvec3 la = light.point > 0 ? a - light.vector : a, lb = light.point > 0 ? b - light.vector : b;
    double alpha = 0, beta = 0;
    if (light.point > 0) {
      const glm::dvec3 lx = x - light.vector, m = glm::cross(la, lb);
      alpha = glm::dot(glm::cross(lx, lb), m) / glm::dot(m, m);
      beta = glm::dot(glm::cross(la, lx), m) / glm::dot(m, m);
      if (alpha < 0 || beta < 0 || alpha + beta < 1) continue;
    } else {
      const glm::dvec3 across = b - a - glm::dot(b - a, light.vector) * light.vector;
      beta = glm::dot(x - a, across) / glm::dot(across, across);
      if (beta < 0 || beta > 1 || glm::dot(x - (a + beta * (b - a)), light.vector) > 0) continue;
    }
    sum += slope < 0 ? e.multiplicity : -e.multiplicity;
  }
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const glm::dvec3 n = glm::cross(b - a, c - a) * static_cast<double>(facing(a, b, c, light));  // toward the light
    const double slope = glm::dot(n, d);
    if (slope == 0) continue;
    const double at = glm::dot(n, a - p) / slope;
    if (at <= 0 || at >= end) continue;
    const glm::dvec3 x = p + at * d, m = glm::cross(b - a, c - a);
    const bool inside = glm::dot(m, glm::cross(b - a, x - a)) > 0 && glm::dot(m, glm::cross(c - b, x - b)) > 0 &&
                        glm::dot(m, glm::cross(a - c, x - c)) > 0;
    if (inside) sum += slope < 0 ? 1 : -1;
  }
  return sum;
}

TEST(Silhouette, OfACubeIsSixEdges) {
  const Mesh mesh = cube();
  const MeshEdges edges(mesh);
  EXPECT_EQ(edges.edges().size(), 18U) << "12 edges and 6 diagonals";
  const auto found = silhouette(edges, in_double(mesh), {{3, 4, 5}, 1});
  EXPECT_EQ(found.size(), 6U);
  for (const SilhouetteEdge& e : found) EXPECT_EQ(std::abs(e.multiplicity), 2);
  EXPECT_EQ(silhouette(edges, in_double(mesh), {{3, 0.1, 0.2}, 1}).size(), 4U);
  EXPECT_EQ(silhouette(edges, in_double(mesh), {{0.1, 0.2, 0.3}, 1}).size(), 0U) << "from within there is none";
}

TEST(Silhouette, OfAnyMeshIsClosedLoops) {
  const std::shared_ptr<const Mesh> torus = wavy_torus(2000);
  const Mesh meshes[] = {*torus, cube(), soup(7, 40), *square(1)};
  for (const Mesh& mesh : meshes) {
    const MeshEdges edges(mesh);
    for (std::uint32_t i = 0; i < 20; ++i) {
      for (const double point : {0.0, 1.0}) {
        const auto found = silhouette(edges, in_double(mesh), {random_point(1, i, 3), point});
        for (const auto& [vertex, sum] : balance(found)) EXPECT_EQ(sum, 0) << "as many edges leave a vertex as arrive there";
      }
    }
  }
}

// Sum over the way: count at its end = count at its begin + signed crossings.
TEST(Silhouette, CrossingsCountTheTrianglesBetweenPointAndLight) {
  const std::shared_ptr<const Mesh> torus = wavy_torus(200);
  const Mesh meshes[] = {*torus, cube(), soup(11, 30), soup(12, 5), *square(1)};
  int ways = 0, highest = 0, changes = 0;
  for (const Mesh& mesh : meshes) {
    const MeshEdges edges(mesh);
    for (std::uint32_t i = 0; i < 400; ++i) {
      for (const double point : {0.0, 1.0}) {
        const glm::dvec3 where = random_point(2, i, 2);
        const HomogeneousLight light{point > 0 ? where : glm::normalize(where), point};
        const auto found = silhouette(edges, in_double(mesh), light);
        const glm::dvec3 from = random_point(3, i, 3), to = random_point(4, i, 3);
        const int before = between(mesh, from, light), after = between(mesh, to, light);
        EXPECT_EQ(before + crossings(mesh, found, from, to - from, 1, light), after) << "way " << i;
        ++ways;
        highest = std::max(highest, after);
        changes += before != after;
      }
    }
  }
  std::printf("%d ways, %d of them from one count to another, up to %d triangles before the light\n", ways, changes, highest);
  EXPECT_GT(changes, ways / 8);
}

TEST(Silhouette, CoverOfTheCameraIsTheSameCount) {
  const Mesh mesh = soup(21, 60);
  int covered = 0;
  for (std::uint32_t i = 0; i < 500; ++i) {
    for (const double point : {0.0, 1.0}) {
      const glm::dvec3 camera = random_point(5, i, 1.5);
      const glm::dvec3 way = random_point(6, i, 2);
      const HomogeneousLight light{point > 0 ? way - camera : way, point}, in_mesh{way, point};
      int count = 0;
      for (const glm::uvec3& t : mesh.triangles) {
        count += covers(glm::dvec3(mesh.positions[t.x]) - camera, glm::dvec3(mesh.positions[t.y]) - camera,
                        glm::dvec3(mesh.positions[t.z]) - camera, light);
      }
      EXPECT_EQ(count, between(mesh, camera, in_mesh)) << i;
      covered += count > 0;
    }
  }
  std::printf("%d of 1000 cameras covered\n", covered);
  EXPECT_GT(covered, 100);
}

// The light exactly behind a vertex or an edge, as in scenes of round numbers: of a closed mesh the way still crosses an even
// count.
TEST(Silhouette, TiesAreBrokenForAllTrianglesAlike) {
  const Mesh mesh = cube();
  int ties = 0;
  for (int i = 0; i < 7 * 7 * 7; ++i) {
    const glm::dvec3 light(i % 7 - 3, i / 7 % 7 - 3, i / 49 - 3);
    if (glm::length(light) == 0) continue;
    for (const double away : {3.0, 4.0, 6.0}) {  // the camera on the other side of the centre
      const glm::dvec3 camera = -away * light;
      const HomogeneousLight relative{light - camera, 1};
      if (std::max({std::fabs(light.x), std::fabs(light.y), std::fabs(light.z)}) <= 0.5) continue;
      int count = 0;
      for (const glm::uvec3& t : mesh.triangles) {
        count += covers(glm::dvec3(mesh.positions[t.x]) - camera, glm::dvec3(mesh.positions[t.y]) - camera,
                        glm::dvec3(mesh.positions[t.z]) - camera, relative);
      }
      EXPECT_EQ(count, 2) << light.x << ' ' << light.y << ' ' << light.z;
      ++ties;
    }
  }
  std::printf("%d ways through the centre\n", ties);
}

TEST(Silhouette, IsKeptWhileTheMeshLives) {
  const std::shared_ptr<const Mesh> mesh = wavy_torus(500);
  const HomogeneousLight light{{1, 3, 2}, 1};
  const auto first = mesh_silhouette(mesh, glm::dmat4(1), light);
  EXPECT_EQ(mesh_edges(mesh), mesh_edges(mesh));
  EXPECT_EQ(mesh_silhouette(mesh, glm::dmat4(1), light), first);
  EXPECT_NE(mesh_silhouette(mesh, glm::dmat4(1), {{1, 3, 2.5}, 1}), first);
  glm::dmat4 mirrored(1);
  mirrored[0][0] = -1;
  const auto turned = mesh_silhouette(mesh, mirrored, {{-1, 3, 2}, 1});
  ASSERT_EQ(turned->size(), first->size()) << "the same edges, run through the other way, for the same shadow";
  for (std::size_t i = 0; i < first->size(); ++i) EXPECT_EQ((*turned)[i].multiplicity, -(*first)[i].multiplicity);
}

}  // namespace

}  // namespace airlight
