#include "common/scene/convert_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>

#include "common/scene/files.h"
#include "common/scene/gltf_scene.h"
#include "common/scene/mesh_file.h"

namespace airlight {

namespace {

std::string text(double v) { return fmt::format("{}", v); }  // the shortest decimals that give the same bits
std::string text(const glm::dvec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }
std::string text(const glm::vec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

// In double quotes, whole, as JSON has it.
std::string string(std::string_view from) {
  std::string out = "\"";
  for (const char c : from) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string relative(const std::string& path, const std::string& folder) {
  const auto from = std::filesystem::absolute(folder).lexically_normal(), to = std::filesystem::absolute(path).lexically_normal();
  return to.lexically_relative(from).generic_string();
}

// A value as it stood in the file `from`, with the names of files in it as they are from `folder`.
std::string text(const json::Value& v, const std::string& from, const std::string& folder) {
  constexpr std::array<std::string_view, 2> files{"file", "gaussians_file"};
  switch (v.kind) {
    case json::Kind::null:
      return "null";
    case json::Kind::boolean:
      return v.boolean ? "true" : "false";
    case json::Kind::number:
      return v.text;
    case json::Kind::string: {
      const bool file = std::find(files.begin(), files.end(), v.key) != files.end();
      return string(file ? relative(resolved(folder_of(from), v.text), folder) : v.text);
    }
    default:
      break;
  }
  const bool object = v.kind == json::Kind::object;
  std::string out = object ? "{ " : "[";
  for (const json::Value& item : v.items) {
    if (&item != &v.items.front()) out += ", ";
    if (object) out += string(item.key) + ": ";
    out += text(item, from, folder);
  }
  return out + (object ? " }" : "]");
}

std::string camera_text(const Camera& c) {
  return fmt::format(
      "  \"camera\": {{ \"position\": {}, \"look_at\": {}, \"up\": {}, \"vertical_fov\": {}, \"resolution\": [{}, {}] }},\n",
      text(c.position), text(c.look_at), text(c.up), text(c.vertical_fov), c.resolution.width, c.resolution.height);
}

std::string lights_text(const std::vector<LightSource>& lights) {
  std::string out;
  for (const LightSource& l : lights) {
    out += out.empty() ? "" : ",\n";
    out += l.type == LightType::point ? fmt::format("    {{ \"type\": \"point\", \"position\": {}, \"intensity\": {} }}",
                                                    text(l.position), text(l.power))
                                      : fmt::format("    {{ \"type\": \"directional\", \"direction\": {}, \"irradiance\": {} }}",
                                                    text(l.direction), text(l.power));
  }
  return "  \"lights\": [\n" + out + "\n  ],\n";
}

// With the medium's homogeneous part replaced where fog is given.
std::string settings_text(const json::Value& settings, std::optional<double> fog, const std::string& from,
                          const std::string& folder) {
  std::string out;
  const std::string homogeneous = fog ? fmt::format("\"homogeneous\": {{ \"extinction\": {} }}", text(*fog)) : "";
  bool medium = false;
  for (const json::Value& member : settings.items) {
    if (member.key != "medium" || !fog) {
      out += fmt::format("  {}: {},\n", string(member.key), text(member, from, folder));
      continue;
    }
    medium = true;
    std::string inside = homogeneous;
    for (const json::Value& m : member.items) {
      if (m.key != "homogeneous") inside += fmt::format(", {}: {}", string(m.key), text(m, from, folder));
    }
    out += "  \"medium\": { " + inside + " },\n";
  }
  if (fog && !medium) out += "  \"medium\": { " + homogeneous + " },\n";
  return out;
}

std::string gltf_text(const GltfScene& g, const std::string& path, const std::string& folder, std::optional<double> fog) {
  const Scene& s = g.loading.scene;
  std::string out = "{\n  \"airlight\": 1,\n" + camera_text(s.camera);
  if (g.settings.kind == json::Kind::object || fog) out += settings_text(g.settings, fog, path, folder);
  if (!s.lights.empty()) out += lights_text(s.lights);
  std::string surfaces;
  for (std::size_t i = 0; i < s.surfaces.size(); ++i) {
    const Material& m = s.surfaces[i].material;
    surfaces += surfaces.empty() ? "" : ",\n";
    surfaces += fmt::format(
        "    {{ \"mesh\": {}, \"part\": {}, \"material\": {{ \"diffuse\": {}, \"specular\": {}, \"shininess\": {} }} }}",
        string(relative(path, folder)), g.loading.surfaces[i].part, text(m.diffuse), text(m.specular), m.shininess);
  }
  return out + "  \"surfaces\": [" + (surfaces.empty() ? "" : "\n" + surfaces + "\n  ") + "]\n}\n";
}

// Looks down on it from its front, a sun behind the viewer's left shoulder.
std::string mesh_text(const std::string& path, const std::string& folder, std::optional<double> fog, Progress& progress) {
  const std::shared_ptr<const Mesh> mesh = read_mesh_file(path, false, -1, progress).mesh;
  glm::dvec3 least(mesh->positions.front()), most = least;
  for (const glm::vec3& p : mesh->positions) least = glm::min(least, glm::dvec3(p)), most = glm::max(most, glm::dvec3(p));
  Camera c;
  c.look_at = 0.5 * (least + most);
  const double radius = std::max(0.5 * glm::length(most - least), 1e-3);
  c.position = c.look_at + 2.8 * radius * glm::normalize(glm::dvec3(0, 0.3, 1));
  LightSource sun;
  sun.type = LightType::directional;
  sun.direction = {0.5, -1, -0.75};
  sun.power = glm::dvec3(3);
  std::string out = "{\n  \"airlight\": 1,\n" + camera_text(c) + settings_text({}, fog, path, folder) + lights_text({sun});
  return out + fmt::format("  \"surfaces\": [\n    {{ \"mesh\": {} }}\n  ]\n}}\n", string(relative(path, folder)));
}

}  // namespace

ConvertedScene convert_scene(const std::string& path, const std::string& folder, std::optional<double> fog, Progress& progress) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".gltf" || extension == ".glb") {
    GltfScene g = load_gltf(path, fog, progress);
    return {gltf_text(g, path, folder, fog), std::move(g.notes)};
  }
  return {mesh_text(path, folder, fog, progress), {path + ": materials and textures are left out"}};
}

}  // namespace airlight
