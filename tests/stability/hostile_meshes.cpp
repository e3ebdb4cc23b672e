#include "tests/stability/hostile_meshes.h"

#include "tests/truth/scenes.h"

namespace airlight {

namespace {

// Each triangle with corners of its own.
void add_triangle(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const auto first = static_cast<unsigned>(mesh.positions.size());
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double length = glm::length(n);
  for (const glm::dvec3& p : {a, b, c}) {
    mesh.positions.emplace_back(p);
    mesh.normals.push_back(length > 1e-20 ? glm::vec3(n / length) : glm::vec3(0, 1, 0));
  }
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

Mesh floor_of(double half) {
  Mesh mesh;
  add_parallelogram(mesh, {-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half});
  return mesh;
}

}  // namespace

std::shared_ptr<const Mesh> hostile_mesh(Draw& draw, std::string& trait) {
  Mesh mesh;
  switch (draw.whole(0, 10)) {
    case 0:
    case 1:
      mesh = box(glm::dvec3(-0.5), glm::dvec3(0.5));
      break;
    case 2:
    case 3:
      mesh = floor_of(2);
      break;
    case 4:
      return wavy_torus(200);
    case 5:
      trait = "slivers";
      for (int i = 0; i < 12; ++i) {
        const glm::dvec3 a = draw.vector(0.7), b = draw.vector(0.7);
        add_triangle(mesh, a, b, a + draw.between(0.2, 0.8) * (b - a) + 1e-4 * draw.direction());
      }
      break;
    case 6:
      trait = "triangles without area";
      mesh = box(glm::dvec3(-0.5), glm::dvec3(0.5));
      for (int i = 0; i < 6; ++i) {
        const glm::dvec3 a = draw.vector(0.7), b = draw.vector(0.7);
        add_triangle(mesh, a, b, i % 2 == 0 ? a : 0.5 * (a + b));
        add_triangle(mesh, a, a, a);
      }
      break;
    case 7:
      trait = "duplicate triangles";
      mesh = box(glm::dvec3(-0.5), glm::dvec3(0.5));
      for (std::size_t i = 0, n = mesh.triangles.size(); i < n; ++i) {
        const glm::uvec3 t = mesh.triangles[i];
        if (draw.chance(0.5)) mesh.triangles.push_back(t);
        if (draw.chance(0.5)) mesh.triangles.emplace_back(t.x, t.z, t.y);  // its other side
      }
      break;
    case 8:
      trait = "coplanar triangles";
      for (int i = 0; i < 8; ++i) {
        const glm::dvec3 a(draw.between(-0.7, 0.7), 0, draw.between(-0.7, 0.7));
        add_triangle(mesh, a, a + glm::dvec3(draw.between(-1, 1), 0, 0.3), a + glm::dvec3(0.3, 0, draw.between(-1, 1)));
      }
      break;
    case 9:
      trait = "open fan with holes";
      for (int i = 0; i < 14; ++i) {
        const auto at = [&](int k) {
          const double turn = 0.41 * k;
          return glm::dvec3(0.8 * std::cos(turn), 0.2 * std::sin(3 * turn), 0.8 * std::sin(turn));
        };
        if (i % 4 != 3) add_triangle(mesh, glm::dvec3(0, 0.3, 0), at(i), at(i + 1));
      }
      break;
    default:
      trait = "triangles that cross";
      for (int i = 0; i < 8; ++i) add_triangle(mesh, draw.vector(0.7), draw.vector(0.7), draw.vector(0.7));
  }
  return std::make_shared<const Mesh>(std::move(mesh));
}

}  // namespace airlight
