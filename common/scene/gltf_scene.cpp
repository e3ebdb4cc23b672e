// Geometry comes through assimp, camera and KHR_lights_punctual from the JSON (assimp 5.2 keeps one light and one camera of those
// that several nodes share).
#include "common/scene/gltf_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "common/error.h"
#include "common/scene/files.h"
#include "common/scene/limits.h"
#include "common/scene/mesh_check.h"
#include "common/scene/mesh_file.h"
#include "common/scene/parse.h"

namespace airlight {

namespace {

// Photometric to radiant: lumens in a watt at 555 nm (SI definition of the candela).
constexpr double lumens_a_watt = 683;
constexpr int standard_height = 600;  // [pixel]: glTF has an aspect ratio but no resolution
constexpr int deepest = 1000;

const json::Value* member(const json::Value& object, std::string_view key) {
  for (const json::Value& m : object.items) {
    if (object.kind == json::Kind::object && m.key == key) return &m;
  }
  return nullptr;
}

// Reads what the scene needs and passes over everything else that glTF allows.
class GltfReader {
 public:
  GltfReader(const json::Value& root, const std::string& file, Scene& scene) : root_(root), file_(file), scene_(scene) {}

  // Returns "airlight" in the extras of the scene, or null.
  const json::Value* read() {
    const json::Value* chosen = member(root_, "scene");
    const Node scene = element("scenes", chosen ? index(*chosen, "scene") : 0, root_.place);
    if (const json::Value* roots = member(scene.value(), "nodes")) {
      for (const Node& n : Node(*roots, file_, scene.path() + ".nodes").array())
        visit(index(n.value(), n.path()), n.value().place, glm::dmat4(1.0), 0);
    }
    if (!has_camera_) throw InputError(file_ + ": no camera, expected one with a perspective");
    const json::Value* extras = member(scene.value(), "extras");
    return extras ? member(*extras, "airlight") : nullptr;
  }

 private:
  std::size_t index(const json::Value& v, const std::string& path) const {
    return static_cast<std::size_t>(Node(v, file_, path).integer(0, 1 << 30));
  }

  // list[i] of the file; `place` is where it is asked for.
  Node element(const std::string& list, std::size_t i, json::Place place, const json::Value* in = nullptr) const {
    const json::Value* values = member(in ? *in : root_, list);
    if (!values || values->kind != json::Kind::array || i >= values->items.size()) {
      throw InputError(json::message(file_, place, fmt::format("{}[{}] does not exist, expected it", list, i)));
    }
    return {values->items[i], file_, fmt::format("{}[{}]", list, i)};
  }

  static Range any() { return limits::component; }

  glm::dmat4 transform_of(const Node& node) const {
    const auto list = [&](std::string_view key, std::size_t count) -> std::vector<double> {
      const json::Value* v = member(node.value(), key);
      if (!v) return {};
      const Node n(*v, file_, node.path() + "." + std::string(key));
      std::vector<double> numbers;
      for (const Node& e : n.array()) numbers.push_back(e.number(any()));
      if (numbers.size() != count) n.fail(fmt::format("expected {} numbers", count));
      return numbers;
    };
    if (const json::Value* matrix = member(node.value(), "matrix"))
      return Node(*matrix, file_, node.path() + ".matrix").mat4(any());
    glm::dmat4 moving(1.0), turning(1.0), scaling(1.0);
    if (const auto t = list("translation", 3); !t.empty()) moving[3] = glm::dvec4(t[0], t[1], t[2], 1);
    if (const auto q = list("rotation", 4); !q.empty()) turning = glm::mat4_cast(glm::dquat(q[3], q[0], q[1], q[2]));
    if (const auto s = list("scale", 3); !s.empty()) scaling[0][0] = s[0], scaling[1][1] = s[1], scaling[2][2] = s[2];
    return moving * turning * scaling;
  }

  void visit(std::size_t i, json::Place place, const glm::dmat4& parent, int depth) {
    const Node node = element("nodes", i, place);
    if (depth > deepest || std::find(seen_.begin(), seen_.end(), i) != seen_.end())
      node.fail("reached twice, expected a tree of nodes");
    seen_.push_back(i);
    const glm::dmat4 world = parent * transform_of(node);
    if (const json::Value* c = member(node.value(), "camera"); c && !has_camera_)
      camera(element("cameras", index(*c, node.path()), c->place), world);
    const json::Value* extensions = member(node.value(), "extensions");
    const json::Value* punctual = extensions ? member(*extensions, "KHR_lights_punctual") : nullptr;
    if (const json::Value* l = punctual ? member(*punctual, "light") : nullptr) light(*l, node, world);
    if (const json::Value* children = member(node.value(), "children")) {
      for (const Node& child : Node(*children, file_, node.path() + ".children").array()) {
        visit(index(child.value(), child.path()), child.value().place, world, depth + 1);
      }
    }
  }

  void camera(const Node& node, const glm::dmat4& world) {
    const json::Value* p = member(node.value(), "perspective");
    if (!p) node.fail("not a perspective camera, expected one");
    const Node perspective(*p, file_, node.path() + ".perspective");
    const json::Value* yfov = member(*p, "yfov");
    if (!yfov) perspective.fail("missing key, expected \"yfov\"");
    constexpr double degree = std::numbers::pi / 180;
    Camera& c = scene_.camera;
    c.vertical_fov = Node(*yfov, file_, perspective.path() + ".yfov")
                         .number({limits::field_of_view.least * degree, limits::field_of_view.most * degree, "rad"}) /
                     degree;
    double aspect = static_cast<double>(c.resolution.width) / c.resolution.height;
    if (const json::Value* a = member(*p, "aspectRatio"))
      aspect = Node(*a, file_, perspective.path() + ".aspectRatio").number({0.01, 100, ""});
    c.resolution = {static_cast<int>(std::floor(standard_height * aspect + 0.5)), standard_height};
    c.position = glm::dvec3(world[3]);
    const glm::dvec3 forward = -glm::dvec3(world[2]), up(world[1]);
    if (!(glm::length(glm::cross(forward, up)) > 1e-9 * glm::length(forward) * glm::length(up)))
      node.fail("its node has a singular transform");
    c.look_at = c.position + glm::normalize(forward) * (1 + 1e-6 * glm::length(c.position));
    c.up = glm::normalize(up);
    has_camera_ = true;
  }

  void light(const json::Value& which, const Node& at, const glm::dmat4& world) {
    const json::Value* extensions = member(root_, "extensions");
    const json::Value* punctual = extensions ? member(*extensions, "KHR_lights_punctual") : nullptr;
    const Node node = element("lights", index(which, at.path()), which.place, punctual ? punctual : &root_);
    const json::Value* type = member(node.value(), "type");
    if (!type) node.fail("missing key, expected \"type\"");
    static constexpr auto types = keys("point", "directional", "spot");
    const Node type_node(*type, file_, node.path() + ".type");
    const bool directional = type_node.choice(types) == "directional";  // else point, or spot, whose cone is left out

    LightSource l;
    glm::dvec3 color(1);
    double intensity = 1;
    if (const json::Value* c = member(node.value(), "color")) color = Node(*c, file_, node.path() + ".color").vec3({0, 1e6, ""});
    if (const json::Value* v = member(node.value(), "intensity")) {
      intensity = Node(*v, file_, node.path() + ".intensity").number({0, 1e8, directional ? "lx" : "cd"});
    }
    l.type = directional ? LightType::directional : LightType::point;
    l.power = color * intensity / lumens_a_watt;
    l.position = glm::dvec3(world[3]);
    if (l.type == LightType::directional) {
      if (!(glm::length(glm::dvec3(world[2])) > 1e-9)) at.fail("a light with a singular transform");
      // As often as it takes to change no bit any more: a scene file with these numbers is the same.
      for (glm::dvec3 d = -glm::dvec3(world[2]); l.direction != d; d = glm::normalize(d)) l.direction = d;
      l.position = {};
    }
    scene_.lights.push_back(l);
  }

  const json::Value& root_;
  const std::string& file_;
  Scene& scene_;
  bool has_camera_ = false;
  std::vector<std::size_t> seen_;
};

// The JSON of a .glb is its first chunk; check_mesh_bytes() has looked at the sizes.
std::string json_of(const std::string& path, std::string bytes) {
  if (std::filesystem::path(path).extension() != ".glb") return bytes;
  check_mesh_bytes(path, ".glb", bytes);
  std::uint32_t length = 0;
  for (std::size_t i = 0; i < 4 && bytes.size() >= 20; ++i)
    length |= std::uint32_t{static_cast<std::uint8_t>(bytes[12 + i])} << (8 * i);
  return bytes.size() >= 20 ? bytes.substr(20, length) : "";
}

// What the file says of its looks and is not rendered.
std::vector<std::string> notes_of(const json::Value& root, const std::string& file) {
  std::vector<std::string> notes;
  const auto note = [&](std::string_view what) { notes.push_back(fmt::format("{}: {}", file, what)); };
  const auto filled = [&](std::string_view key) {
    const json::Value* v = member(root, key);
    return v && !v->items.empty();
  };
  if (const json::Value* cameras = member(root, "cameras"); cameras && cameras->items.size() > 1)
    note("more than one camera, the first that its scene has is taken");
  if (filled("textures")) note("textures are left out, factors alone color its materials");
  if (filled("animations")) note("animations are left out");
  if (filled("skins")) note("skins are left out");
  bool emissive = false, alpha = false;
  if (const json::Value* materials = member(root, "materials")) {
    for (const json::Value& m : materials->items) {
      if (const json::Value* e = member(m, "emissiveFactor")) {
        for (const json::Value& c : e->items) emissive |= c.number > 0;
      }
      const json::Value* mode = member(m, "alphaMode");
      alpha |= mode && mode->text != "OPAQUE";
    }
  }
  bool spot = false, range = false;
  const json::Value* extensions = member(root, "extensions");
  const json::Value* punctual = extensions ? member(*extensions, "KHR_lights_punctual") : nullptr;
  if (const json::Value* lights = punctual ? member(*punctual, "lights") : nullptr) {
    for (const json::Value& l : lights->items) {
      const json::Value* type = member(l, "type");
      spot |= type && type->text == "spot";
      range |= member(l, "range") != nullptr;
    }
  }
  if (spot) note("the cones of spot lights are left out, they shine in all directions");
  if (range) note("the range of lights is left out, they shine on");
  if (emissive) note("emission of materials is left out");
  if (alpha) note("transparency of materials is left out, they are opaque");
  if (const json::Value* used = member(root, "extensionsUsed")) {
    for (const json::Value& e : used->items) {
      if (e.text != "KHR_lights_punctual") note(fmt::format("extension {} is left out", json::quoted(e.text)));
    }
  }
  return notes;
}

}  // namespace

Material gltf_material(const glm::dvec3& base, double metallic, double roughness) {
  const double metal = std::clamp(metallic, 0.0, 1.0), width = std::clamp(roughness, 0.0, 1.0) * std::clamp(roughness, 0.0, 1.0);
  Material m;
  for (int k = 0; k < 3; ++k) {
    const double color = std::clamp(base[k], 0.0, 1.0), mirrored = 0.04 * (1 - metal) + color * metal;
    m.diffuse[k] = static_cast<float>(color * (1 - metal) * (1 - mirrored));
    // Rounded apart they must not reflect more than arrives.
    m.specular[k] = static_cast<float>(std::max(0.0, std::min(mirrored, 1 - static_cast<double>(m.diffuse[k]) - 1e-6)));
  }
  const double about_half = width > 0 ? 2 / (width * width) - 2 : 1e30;
  m.shininess = static_cast<float>(std::min(about_half / 4, limits::shininess.most));
  return m;
}

std::vector<std::string> gltf_notes(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension != ".gltf" && extension != ".glb") return {};
  return notes_of(json::parse(json_of(path, read_file(path, std::uint64_t{8} << 30U)), path), path);
}

GltfScene load_gltf(const std::string& path, std::optional<double> fog, Progress& progress) {
  GltfScene out;
  Scene& scene = out.loading.scene;
  const json::Value root = json::parse(json_of(path, read_file(path, std::uint64_t{8} << 30U)), path);
  GltfReader reader(root, path, scene);
  if (const json::Value* settings = reader.read()) {
    out.settings = *settings;
    SceneFiles files(folder_of(path));
    parse_gltf_settings(Node(*settings, path, "extras.airlight"), files, out.loading, progress);
  }
  if (fog) scene.medium.extinction = *fog;
  out.notes = notes_of(root, path);

  // One surface a material, in world coordinates. A scene without meshes is one of lights only.
  if (member(root, "meshes")) {
    ImportedFile file = read_mesh_parts(path, progress);
    for (ImportedMesh& m : file.meshes) {
      Surface surface;
      surface.mesh = std::move(m.mesh);
      surface.material = m.material;
      scene.surfaces.push_back(std::move(surface));
      out.loading.surfaces.push_back({file.content_hash, false, {}, m.part});
    }
  }
  scene.hash = scene_hash(out.loading);
  return out;
}

}  // namespace airlight
