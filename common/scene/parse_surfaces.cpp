#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <numbers>

#include "common/scene/limits.h"
#include "common/scene/mesh_check.h"
#include "common/scene/parse.h"

namespace airlight {

namespace {

// Turns by this angle about one axis. Multiples of 90 degrees are exact; the detour over long double makes the other
// bits independent of the C library.
glm::dmat4 rotation(int axis, double degrees) {
  const double quarter = std::remainder(degrees, 360.0) / 90;
  double c = 0, s = 0;
  if (quarter == std::floor(quarter)) {
    c = std::abs(quarter) == 1 ? 0 : quarter == 0 ? 1 : -1;
    s = std::abs(quarter) == 1 ? quarter : 0;
  } else {
    const long double angle = static_cast<long double>(degrees) / 180 * std::numbers::pi_v<long double>;
    c = static_cast<double>(std::cos(angle));
    s = static_cast<double>(std::sin(angle));
  }
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  glm::dmat4 m(1.0);
  m[u][u] = c, m[u][v] = s;
  m[v][u] = -s, m[v][v] = c;
  return m;
}

glm::dmat4 translate_rotate_scale(const Object& o, std::string_view factor) {
  glm::dmat4 scaling(1.0), turning(1.0), moving(1.0);
  if (const auto scale = o.find(factor)) {
    const bool one = scale->value().kind == json::Kind::number;
    const glm::dvec3 s = one ? glm::dvec3(scale->number(limits::component)) : scale->vec3(limits::component);
    if (s.x == 0 || s.y == 0 || s.z == 0) scale->fail("0, expected factors other than 0");
    for (int k = 0; k < 3; ++k) scaling[k][k] = s[k];
  }
  if (const auto rotate = o.find("rotate")) {  // about x, then y, then z
    const glm::dvec3 angles = rotate->vec3(limits::degrees);
    turning = rotation(2, angles.z) * rotation(1, angles.y) * rotation(0, angles.x);
  }
  if (const auto translate = o.find("translate")) moving[3] = glm::dvec4(translate->vec3(limits::coordinate), 1);
  return moving * turning * scaling;
}

void check_extent(const Node& node, const Surface& surface) {
  for (const glm::vec3& p : surface.mesh->positions) {
    const glm::dvec3 w(surface.transform * glm::dvec4(glm::dvec3(p), 1.0));
    const double largest = std::max({std::abs(w.x), std::abs(w.y), std::abs(w.z)});
    if (!(largest <= limits::farthest)) {
      node.fail(fmt::format("the transform moves a vertex to ({}, {}, {}), expected coordinates up to {} m", w.x, w.y, w.z,
                            limits::farthest));
    }
  }
}

}  // namespace

// The determinant against that of a box with the same edges: scale alone does not make a matrix singular.
bool singular(const glm::dmat4& m) {
  const glm::dmat3 linear(m);
  const double box = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
  return !(std::abs(glm::determinant(linear)) > 1e-9 * box && box > 1e-30);
}

glm::dmat4 parse_transform(const Object& o, std::string_view factor) {
  const auto transform = o.find("transform");
  glm::dmat4 m(1.0);
  if (transform) {
    for (const std::string_view other : {std::string_view("translate"), std::string_view("rotate"), factor}) {
      if (const auto node = o.find(other))
        node->fail(fmt::format("transform is given too, expected it or translate, rotate, {}", factor));
    }
    m = transform->mat4(limits::component);
    if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1) {
      transform->fail("not affine, expected numbers 4, 8 and 12 to be 0 and number 16 to be 1 (column by column)");
    }
  } else {
    m = translate_rotate_scale(o, factor);
  }
  if (singular(m)) (transform ? *transform : o.node()).fail("a singular transform, expected an invertible one");
  return m;
}

Material parse_material(const Node& node) {
  static constexpr auto known = keys("diffuse", "specular", "shininess", "brdf");
  const Object o(node, known);
  Material m;
  const auto diffuse = o.find("diffuse"), specular = o.find("specular");
  if (o.find("brdf")) {
    for (const auto& beside : {diffuse, specular, o.find("shininess")}) {
      if (beside) beside->fail("beside brdf, expected one or the other");
    }
  }
  const glm::dvec3 d = diffuse ? diffuse->vec3(limits::fraction) : glm::dvec3(m.diffuse);
  const glm::dvec3 s = specular ? specular->vec3(limits::fraction) : glm::dvec3(m.specular);
  for (int k = 0; k < 3; ++k) {
    // A sum above 1 would reflect more than arrives.
    if (d[k] + s[k] > 1 + 1e-9) {
      (specular ? *specular : *diffuse)
          .fail(fmt::format("diffuse + specular = {} in channel {}, expected at most 1", d[k] + s[k], k));
    }
  }
  m.diffuse = d;
  m.specular = s;
  if (const auto shininess = o.find("shininess")) m.shininess = static_cast<float>(shininess->number(limits::shininess));
  return m;
}

namespace {

// The file that a material names, if it does.
void add_brdf(const Node& material, SceneFiles& files, Surface& surface, std::string& hash) {
  for (const json::Value& member : material.value().items) {
    if (member.key != "brdf") continue;
    const Node node(member, material.file(), material.path() + ".brdf");
    const auto file = files.brdf(node);
    if (!file) continue;
    surface.brdf = file->brdf;
    surface.material = file->material;
    hash = file->content_hash;
  }
}

}  // namespace

void parse_surfaces(const Node& node, SceneFiles& files, Loading& loading, Progress& progress) {
  static constexpr auto known =
      keys("mesh", "transform", "translate", "rotate", "scale", "casts_shadow", "material", "normals", "part", "prt");
  static constexpr auto normals_names = keys("auto", "flat");
  const std::vector<Node> nodes = node.array();
  std::uint64_t triangles = 0, vertices = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    progress.report("loading meshes", static_cast<double>(i) / static_cast<double>(nodes.size()));
    const Object o(nodes[i], known);
    if (const auto prt = o.find("prt"); prt && prt->boolean()) {
      prt->fail("precomputed radiance transfer is not supported by this version, expected false");
    }
    Surface surface;
    surface.transform = parse_transform(o, "scale");
    if (const auto casts = o.find("casts_shadow")) surface.casts_shadow = casts->boolean();
    std::string brdf_hash;
    if (const auto material = o.find("material")) {
      surface.material = parse_material(*material);
      add_brdf(*material, files, surface, brdf_hash);
    }
    const auto normals = o.find("normals");
    const bool flat = normals && normals->choice(normals_names) == "flat";

    const auto part_node = o.find("part");
    const int part = part_node ? part_node->integer(0, 1 << 20) : -1;

    // The file comes last: what the scene says itself is checked without it.
    const Node mesh = o.require("mesh");
    const auto file = files.mesh(mesh, flat, part, progress);
    if (!file) continue;
    surface.mesh = file->mesh;
    check_extent(mesh, surface);
    triangles += surface.mesh->triangles.size();
    vertices += surface.mesh->positions.size();
    if (triangles > most_triangles || vertices >= std::uint64_t{1} << 31U) {
      mesh.fail(fmt::format("{} triangles in all surfaces, expected at most {}", triangles, most_triangles));
    }
    loading.scene.surfaces.push_back(std::move(surface));
    loading.surfaces.push_back({file->content_hash, flat, std::move(brdf_hash), part});
  }
}

}  // namespace airlight
