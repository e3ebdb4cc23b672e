#include "common/scene/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/scene/files.h"
#include "common/scene/limits.h"
#include "common/scene/parse.h"

namespace airlight {

namespace {

constexpr std::uint64_t most_scene_bytes = std::uint64_t{256} << 20U;

// Knobs go on as text; their technique checks them when it is known which one runs.
void parse_technique(const Node& node, Scene& scene) {
  static constexpr auto names =
      keys("auto", "shadow-planes", "gaussian-airlight", "opacity-propagation", "illumination-network", "marching", "reference");
  if (node.value().kind != json::Kind::object) node.fail("expected an object");
  for (const json::Value& member : node.value().items) {
    const Node knob(member, node.file(), "technique." + member.key);
    if (member.key == "name") {
      scene.technique = knob.choice(names);
      continue;
    }
    switch (member.kind) {
      case json::Kind::number:
        scene.settings.emplace_back(member.key, fmt::format("{}", member.number));
        break;
      case json::Kind::boolean:
        scene.settings.emplace_back(member.key, member.boolean ? "true" : "false");
        break;
      case json::Kind::string:
        scene.settings.emplace_back(member.key, knob.string());
        break;
      default:
        knob.fail("expected a number, a string, true or false");
    }
  }
  if (scene.technique.empty()) node.fail("missing key, expected \"name\"");
}

void check_emission(const Node& medium, const Scene& scene) {
  const Medium& m = scene.medium;
  if (m.emission == glm::dvec3(0) || m.extinction > 0 || std::isfinite(scene.sky_distance)) return;
  Node place = medium;
  for (const json::Value& member : medium.value().items) {
    if (member.key == "emission") place = Node(member, medium.file(), "medium.emission");
  }
  place.fail("emission without extinction and without sky_distance adds up to infinity, expected one of them");
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, const std::string& directory, Progress& progress) {
  static constexpr auto known =
      keys("airlight", "camera", "sky_distance", "medium", "lights", "surfaces", "background", "noise", "technique");
  static constexpr std::array<LaterKey, 1> later{{{"animation", "animations are"}}};
  const json::Value root = json::parse(text, name);
  const Object o(Node(root, name, ""), known, later);
  const Node version = o.require("airlight");
  if (version.value().kind != json::Kind::number || version.value().number != 1)
    version.fail("unknown format version, expected 1");

  Loading loading;
  Scene& scene = loading.scene;
  if (const auto camera = o.find("camera")) scene.camera = parse_camera(*camera);
  if (const auto sky = o.find("sky_distance")) scene.sky_distance = sky->number(limits::length);
  if (const auto medium = o.find("medium")) {
    parse_medium(*medium, directory, loading, progress);
    check_emission(*medium, scene);
  }
  if (const auto noise = o.find("noise")) scene.medium.noise = parse_noise(*noise);
  if (const auto lights = o.find("lights")) parse_lights(*lights, directory, loading);
  if (const auto background = o.find("background")) {
    if (scene.environment) background->fail("beside an environment light, expected one or the other");
    scene.background = background->vec3(limits::radiance);
  }
  if (const auto technique = o.find("technique")) parse_technique(*technique, scene);
  if (const auto surfaces = o.find("surfaces")) parse_surfaces(*surfaces, directory, loading, progress);
  scene.hash = scene_hash(loading);
  return std::move(scene);
}

Scene load_scene(const std::string& path, Progress& progress) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".gltf" || extension == ".glb") return load_gltf_scene(path, progress);
  const std::string text = read_file(path, most_scene_bytes);
  return parse_scene(text, path, folder_of(path), progress);
}

Scene load_scene(const std::string& path) {
  NoProgress none;
  return load_scene(path, none);
}

}  // namespace airlight
