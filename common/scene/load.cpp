#include "common/scene/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "common/error.h"
#include "common/scene/files.h"
#include "common/scene/gltf_scene.h"
#include "common/scene/limits.h"
#include "common/scene/parse.h"

namespace airlight {

namespace {

constexpr std::uint64_t most_scene_bytes = std::uint64_t{256} << 20U;

}  // namespace

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

namespace {

void check_emission(const Node& medium, const Scene& scene) {
  const Medium& m = scene.medium;
  if (m.emission == glm::dvec3(0) || m.extinction > 0 || std::isfinite(scene.sky_distance)) return;
  Node place = medium;
  for (const json::Value& member : medium.value().items) {
    if (member.key == "emission") place = Node(member, medium.file(), "medium.emission");
  }
  place.fail("emission without extinction and without sky_distance adds up to infinity, expected one of them");
}

// The keys of the whole file, and its version.
Object whole_scene(const json::Value& root, const std::string& name) {
  static constexpr auto known =
      keys("airlight", "camera", "sky_distance", "medium", "lights", "surfaces", "background", "noise", "animation", "technique");
  Object o(Node(root, name, ""), known);
  const Node version = o.require("airlight");
  if (version.value().kind != json::Kind::number || version.value().number != 1)
    version.fail("unknown format version, expected 1");
  return o;
}

Scene scene_of(const Object& o, SceneFiles& files, Progress& progress) {
  Loading loading;
  Scene& scene = loading.scene;
  if (const auto camera = o.find("camera")) scene.camera = parse_camera(*camera);
  if (const auto sky = o.find("sky_distance")) scene.sky_distance = sky->number(limits::length);
  if (const auto medium = o.find("medium")) {
    parse_medium(*medium, files, loading, progress);
    check_emission(*medium, scene);
  }
  if (const auto noise = o.find("noise")) scene.medium.noise = parse_noise(*noise);
  if (const auto lights = o.find("lights")) parse_lights(*lights, files, loading);
  if (const auto background = o.find("background")) {
    if (scene.environment) background->fail("beside an environment light, expected one or the other");
    scene.background = background->vec3(limits::radiance);
  }
  if (const auto technique = o.find("technique")) parse_technique(*technique, scene);
  if (const auto surfaces = o.find("surfaces")) parse_surfaces(*surfaces, files, loading, progress);
  if (files.use == FileUse::read) scene.hash = scene_hash(loading);
  return std::move(scene);
}

}  // namespace

void parse_gltf_settings(const Node& node, SceneFiles& files, Loading& loading, Progress& progress) {
  static constexpr auto known = keys("medium", "background", "sky_distance", "technique");
  const Object o(node, known);
  Scene& scene = loading.scene;
  if (const auto sky = o.find("sky_distance")) scene.sky_distance = sky->number(limits::length);
  if (const auto medium = o.find("medium")) {
    parse_medium(*medium, files, loading, progress);
    check_emission(*medium, scene);
  }
  if (const auto background = o.find("background")) scene.background = background->vec3(limits::radiance);
  if (const auto technique = o.find("technique")) parse_technique(*technique, scene);
}

struct SceneFile::State {
  std::string name;
  json::Value root;  // null of a glTF file, which is read by itself
  SceneFiles files;
  Animation animation;

  State(json::Value document, const std::string& file, const std::string& directory)
      : name(file), root(std::move(document)), files(directory), animation(root, name) {}

  bool is_gltf() const { return root.kind == json::Kind::null; }
  Scene scene(int frame, FileUse use, Progress& progress) {
    animation.set(frame);
    files.use = use;
    try {
      return scene_of(whole_scene(root, name), files, progress);
    } catch (const InputError& e) {
      if (!animation.animated()) throw;
      throw InputError(fmt::format("{} (frame {})", e.what(), frame));
    }
  }
  void check(int frame, FileUse use) {
    NoProgress none;
    if (!is_gltf()) scene(frame, use, none);
  }
};

SceneFile::SceneFile(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".gltf" || extension == ".glb") {
    state_ = std::make_unique<State>(json::Value(), path, "");
  } else {
    *this = SceneFile(read_file(path, most_scene_bytes), path, folder_of(path));
  }
}

SceneFile::SceneFile(std::string_view text, const std::string& name, const std::string& directory) {
  json::Value root = json::parse(text, name);
  whole_scene(root, name);
  state_ = std::make_unique<State>(std::move(root), name, directory);
  for (const int frame : state_->animation.keyed_frames()) state_->check(frame, FileUse::ignore);
}

SceneFile::~SceneFile() = default;
SceneFile::SceneFile(SceneFile&&) noexcept = default;
SceneFile& SceneFile::operator=(SceneFile&&) noexcept = default;

bool SceneFile::animated() const { return state_->animation.animated(); }
FrameRange SceneFile::frames() const { return state_->animation.frames(); }
std::size_t SceneFile::tracks() const { return state_->animation.tracks(); }
std::vector<std::string> SceneFile::numbered_files() const { return state_->animation.numbered_files(); }

Scene SceneFile::scene(int frame, Progress& progress) {
  if (state_->is_gltf()) return std::move(load_gltf(state_->name, std::nullopt, progress).loading.scene);
  Scene scene = state_->scene(frame, FileUse::read, progress);
  state_->files.end_frame();
  return scene;
}

void SceneFile::check(int frame) { state_->check(frame, FileUse::look); }

Scene load_scene(const std::string& path, Progress& progress) {
  SceneFile file(path);
  return file.scene(file.frames().first, progress);
}

Scene load_scene(const std::string& path) {
  NoProgress none;
  return load_scene(path, none);
}

Scene parse_scene(std::string_view text, const std::string& name, const std::string& directory, Progress& progress) {
  SceneFile file(text, name, directory);
  return file.scene(file.frames().first, progress);
}

}  // namespace airlight
