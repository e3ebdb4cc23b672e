#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "common/scene/limits.h"
#include "common/scene/parse.h"

namespace airlight {

namespace {

Gaussian parse_gaussian(const Node& node, const Medium& medium) {
  static constexpr auto known = keys("center", "radius", "extinction", "albedo", "emission");
  const Object o(node, known);
  Gaussian g;
  g.center = o.require("center").vec3(limits::coordinate);
  g.radius = o.require("radius").number(limits::radius);
  g.extinction = o.require("extinction").number(limits::extinction);
  const auto albedo = o.find("albedo"), emission = o.find("emission");
  g.albedo = albedo ? albedo->vec3(limits::fraction) : medium.albedo;
  g.emission = emission ? emission->vec3(limits::emission) : medium.emission;
  return g;
}

// By how much a placement that keeps balls round makes them larger; 0 where it does not.
double round_scale(const glm::dmat4& m) {
  const double scale = glm::length(glm::dvec3(m[0]));
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double product = glm::dot(glm::dvec3(m[i]), glm::dvec3(m[k])) / (scale * scale);
      if (!(std::abs(product - (i == k ? 1 : 0)) < 1e-6)) return 0;  // what a turn written with few digits leaves
    }
  }
  return scale;
}

}  // namespace

void parse_gaussians(const Node& node, Medium& medium) {
  for (const Node& g : node.array()) medium.gaussians.push_back(parse_gaussian(g, medium));
}

void parse_gaussians_file(const Node& node, SceneFiles& files, Medium& medium, Progress& progress) {
  glm::dmat4 placement(1.0);
  double scale = 1, size = 1;
  glm::dvec3 albedo = medium.albedo;
  Node named = node;
  if (node.value().kind != json::Kind::string) {
    static constexpr auto known = keys("file", "scale", "transform", "translate", "rotate", "size", "albedo");
    const Object o(node, known);
    placement = parse_transform(o, "size");
    size = round_scale(placement);
    if (size == 0) node.fail("a transform under which Gaussians do not stay round, expected turns and one size");
    if (const auto factor = o.find("scale")) scale = factor->number(limits::extinction);
    if (const auto given = o.find("albedo")) albedo = given->vec3(limits::fraction);
    named = o.require("file");
  }
  const auto read = files.gaussians(named, progress);
  if (!read) return;
  medium.gaussians.reserve(medium.gaussians.size() + read->gaussians.size());
  for (std::size_t i = 0; i < read->gaussians.size(); ++i) {
    Gaussian g = read->gaussians[i];
    g.center = glm::dvec3(placement * glm::dvec4(g.center, 1));
    g.radius *= size;
    g.extinction *= scale;
    if (!read->has_albedo) g.albedo = albedo;
    if (!read->has_emission) g.emission = medium.emission;
    const double farthest = std::max({std::abs(g.center.x), std::abs(g.center.y), std::abs(g.center.z)});
    if (!(farthest <= limits::farthest && g.radius >= limits::radius.least && g.radius <= limits::radius.most &&
          g.extinction <= limits::extinction.most)) {
      node.fail(fmt::format(
          "Gaussian {} is at ({}, {}, {}) with a radius of {} m and an extinction of {} 1/m, expected coordinates up to {} m, "
          "a radius of {}..{} m, at most {} 1/m",
          i, g.center.x, g.center.y, g.center.z, g.radius, g.extinction, limits::farthest, limits::radius.least,
          limits::radius.most, limits::extinction.most));
    }
    medium.gaussians.push_back(g);
  }
}

}  // namespace airlight
