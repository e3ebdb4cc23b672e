#include "common/design/scene_document.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "common/error.h"
#include "common/scene/files.h"
#include "common/scene/json_text.h"
#include "common/scene/load.h"
#include "common/scene/temporary_file.h"

namespace airlight {

namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{256} << 20U;
constexpr std::array<std::string_view, 5> file_keys{"file", "mesh", "brdf", "gaussians_file", "particles_file"};

json::Value vector(const glm::dvec3& v) {
  json::Value value = json::array();
  for (int k = 0; k < 3; ++k) value.items.push_back(json::number(v[k]));
  return value;
}

// The member, an empty object of that name where there was none.
json::Value& object_at(json::Value& root, std::string_view key) {
  if (!json::member(root, key)) json::set(root, key, json::object());
  return *json::member(root, key);
}

bool same(const Gaussian& a, const Gaussian& b) {
  return a.center == b.center && a.radius == b.radius && a.extinction == b.extinction && a.albedo == b.albedo &&
         a.emission == b.emission;
}

}  // namespace

SceneDocument::SceneDocument(const std::string& path) : directory_(folder_of(path)) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".gltf" || extension == ".glb") throw InputError(path + ": a glTF file, expected a scene in JSON to edit");
  SceneFile file(path);
  if (file.animated()) throw InputError(path + ": an animation, expected a still scene to edit");
  NoProgress none;
  scene_ = file.scene(0, none);
  root_ = json::parse(read_file(path, most_bytes), path);
}

void SceneDocument::set_camera(json::Value& root, const Camera& c) const {
  const Camera& before = scene_.camera;
  if (c.position != before.position) json::set(object_at(root, "camera"), "position", vector(c.position));
  if (c.look_at != before.look_at) json::set(object_at(root, "camera"), "look_at", vector(c.look_at));
  if (c.up != before.up) json::set(object_at(root, "camera"), "up", vector(c.up));
  if (c.vertical_fov != before.vertical_fov) json::set(object_at(root, "camera"), "vertical_fov", json::number(c.vertical_fov));
}

void SceneDocument::set_medium(json::Value& root, const Medium& m) const {
  const Medium& before = scene_.medium;
  if (m.extinction != before.extinction) {
    json::Value homogeneous = json::object();
    json::set(homogeneous, "extinction", json::number(m.extinction));
    json::set(object_at(root, "medium"), "homogeneous", std::move(homogeneous));
  }
  if (std::equal(m.gaussians.begin(), m.gaussians.end(), before.gaussians.begin(), before.gaussians.end(), same)) return;
  json::Value all = json::array();
  all.items.reserve(m.gaussians.size());
  for (const Gaussian& g : m.gaussians) {
    json::Value one = json::object();
    json::set(one, "center", vector(g.center));
    json::set(one, "radius", json::number(g.radius));
    json::set(one, "extinction", json::number(g.extinction));
    if (g.albedo != m.albedo) json::set(one, "albedo", vector(g.albedo));
    if (g.emission != m.emission) json::set(one, "emission", vector(g.emission));
    all.items.push_back(std::move(one));
  }
  json::Value& medium = object_at(root, "medium");
  json::remove(medium, "gaussians_file");  // all of them stand here now
  json::set(medium, "gaussians", std::move(all));
}

void SceneDocument::set_lights(json::Value& root, const std::vector<LightSource>& lights) const {
  json::Value* all = json::member(root, "lights");
  if (!all) return;
  std::size_t i = 0;
  for (json::Value& light : all->items) {
    const json::Value* type = json::member(light, "type");
    if (type && type->text == "environment") continue;
    const LightSource &now = lights[i], &before = scene_.lights[i];
    ++i;
    const bool point = now.type == LightType::point;
    if (now.position != before.position) json::set(light, "position", vector(now.position));
    if (now.direction != before.direction) json::set(light, "direction", vector(now.direction));
    if (now.power != before.power) json::set(light, point ? "intensity" : "irradiance", vector(now.power));
  }
}

void SceneDocument::set_technique(json::Value& root, const Scene& edited) const {
  if (edited.technique == scene_.technique && edited.settings == scene_.settings) return;
  json::remove(root, "technique");
  if (edited.technique.empty()) return;
  json::Value technique = json::object();
  json::set(technique, "name", json::string(edited.technique));
  for (const auto& [name, value] : edited.settings) json::set(technique, name, json::string(value));
  json::set(root, "technique", std::move(technique));
}

void SceneDocument::rename_files(json::Value& value, const std::string& directory) const {
  for (json::Value& m : value.items) {
    rename_files(m, directory);
    if (m.kind != json::Kind::string || std::find(file_keys.begin(), file_keys.end(), m.key) == file_keys.end()) continue;
    const std::filesystem::path named(m.text);
    if (named.is_absolute()) continue;
    const auto whole = [](const std::filesystem::path& p) { return std::filesystem::absolute(p).lexically_normal(); };
    m.text =
        whole(resolved(directory_, m.text)).lexically_proximate(whole(std::filesystem::path(directory) / "")).generic_string();
  }
}

std::string SceneDocument::text(const Scene& edited, const std::string& directory) const {
  json::Value root = root_;
  set_camera(root, edited.camera);
  set_medium(root, edited.medium);
  set_lights(root, edited.lights);
  set_technique(root, edited);
  rename_files(root, directory);
  return json::text_of(root) + "\n";
}

void SceneDocument::save(const Scene& edited, const std::string& path) const {
  const std::string all = text(edited, folder_of(path));
  TemporaryFile file(path);
  file.write(all.data(), all.size());
  file.rename_to_target();
}

}  // namespace airlight
