#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "common/scene/limits.h"
#include "common/scene/parse.h"

namespace airlight {

namespace {

// A name becomes part of the name of an image (airlight.<name>, in lists with commas).
std::string parse_name(const Node& node, const std::vector<LightSource>& before) {
  std::string name = node.string();
  if (name.size() > 64) node.fail("longer than 64 bytes, expected a shorter name");
  if (name.find_first_of(", /\\") != name.npos)
    node.fail(fmt::format("{}, expected a name without commas, blanks and slashes", json::quoted(name)));
  if (std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; })) {
    node.fail(fmt::format("{}, expected a name that is not a number: those count the lights", json::quoted(name)));
  }
  if (std::any_of(before.begin(), before.end(), [&](const LightSource& l) { return l.name == name; })) {
    node.fail(fmt::format("{} is another light's name, expected unique ones", json::quoted(name)));
  }
  return name;
}

LightSource parse_point(const Node& node) {
  static constexpr auto known = keys("type", "name", "position", "intensity", "radius");
  const Object o(node, known);
  LightSource l;
  l.type = LightType::point;
  l.position = o.require("position").vec3(limits::coordinate);
  l.power = o.require("intensity").vec3(limits::intensity);
  if (const auto radius = o.find("radius")) l.radius = radius->number(limits::radius);
  return l;
}

LightSource parse_directional(const Node& node) {
  static constexpr auto known = keys("type", "name", "direction", "irradiance");
  const Object o(node, known);
  LightSource l;
  l.type = LightType::directional;
  const Node direction = o.require("direction");
  const glm::dvec3 d = direction.vec3(limits::component);
  if (glm::length(d) < 1e-9) direction.fail("a zero vector, expected a direction");
  l.direction = glm::normalize(d);
  l.power = o.require("irradiance").vec3(limits::irradiance);
  return l;
}

Environment parse_environment(const Node& node, SceneFiles& files, std::string& hash) {
  static constexpr auto known = keys("type", "file", "scale", "rotation", "radiance");
  const Object o(node, known);
  Environment e;
  const auto radiance = o.find("radiance"), scale = o.find("scale"), rotation = o.find("rotation");
  if (radiance) {
    for (const auto& beside : {o.find("file"), scale, rotation}) {
      if (beside) beside->fail("beside radiance, expected one or the other");
    }
    e.radiance = radiance->vec3(limits::radiance);
    return e;
  }
  const double factor = scale ? scale->number(limits::factor) : 1;
  e.radiance = glm::dvec3(factor);
  if (rotation) e.rotation = rotation->number(limits::degrees);
  const Node file = o.require("file");
  const auto read = files.environment(file);
  if (!read) return e;
  e.image = read->image;
  hash = read->content_hash;
  const auto largest = static_cast<double>(*std::max_element(e.image->values.begin(), e.image->values.end()));
  if (largest * factor > limits::radiance.most) {
    (scale ? *scale : file)
        .fail(fmt::format("radiance {} W/m^2/sr where the image's value is {}, expected at most {} W/m^2/sr", largest * factor,
                          largest, limits::radiance.most));
  }
  return e;
}

// The type says which keys there are, so it is looked at first.
std::string parse_type(const Node& node) {
  static constexpr auto any = keys("type", "name", "position", "intensity", "radius", "direction", "irradiance", "file", "scale",
                                   "rotation", "radiance", "inner_angle", "outer_angle");
  static constexpr auto types = keys("point", "directional", "environment", "spot");
  const Node type_node = Object(node, any).require("type");
  std::string type = type_node.choice(types);
  if (type == "spot") {
    type_node.fail("spot lights are not supported by this version, expected point, directional or environment");
  }
  return type;
}

}  // namespace

void parse_lights(const Node& node, SceneFiles& files, Loading& loading) {
  Scene& scene = loading.scene;
  for (const Node& n : node.array()) {
    const std::string type = parse_type(n);
    if (type == "environment") {
      if (scene.environment) n.fail("a second environment light, expected one at most");
      scene.environment = parse_environment(n, files, loading.environment_hash);
      continue;
    }
    LightSource light = type == "point" ? parse_point(n) : parse_directional(n);
    for (const json::Value& member : n.value().items) {
      if (member.key == "name") light.name = parse_name(Node(member, n.file(), n.path() + ".name"), scene.lights);
    }
    scene.lights.push_back(std::move(light));
  }
}

}  // namespace airlight
