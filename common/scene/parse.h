// The parts of a scene file, each from its JSON value to its struct. All throw InputError with the place.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/scene/mesh_file.h"
#include "common/scene/reader.h"
#include "common/scene/scene.h"

namespace airlight {

Camera parse_camera(const Node&);
Medium parse_medium(const Node&);
std::vector<LightSource> parse_lights(const Node&);
glm::dmat4 parse_transform(const Object& surface);
Material parse_material(const Node&);

// A scene with what its hash needs beyond the value.
struct LoadedSurface {
  std::string content_hash;
  bool flat = false;
};
struct Loading {
  Scene scene;
  std::vector<LoadedSurface> surfaces;  // one a surface
};

// `directory` is where relative paths start. A file that two surfaces name is read once.
void parse_surfaces(const Node&, const std::string& directory, Loading&, Progress&);

// SHA-256 over every value (defaults filled in, in a fixed order) and the hashes of the files.
std::string scene_hash(const Loading&);

// A glTF file as a whole scene.
Scene load_gltf_scene(const std::string& path, Progress&);

}  // namespace airlight
