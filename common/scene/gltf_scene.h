// glTF files as whole scenes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/progress.h"
#include "common/scene/json.h"
#include "common/scene/parse.h"

namespace airlight {

struct GltfScene {
  Loading loading;
  std::vector<std::string> notes;  // what of the file is not rendered, a line each
  json::Value settings;            // "airlight" in the extras of its scene: keys of a scene file; null where there is none
};

// Camera, lights (KHR_lights_punctual: candela and lux over 683 lm/W are W/sr and W/m^2), one surface a material. Of a material
// its base colour, metallic and roughness factors: see gltf_material(). In the extras of the scene, "airlight": { "medium": ...,
// "background": ..., "sky_distance": ..., "technique": ... } are the keys of a scene file. `fog`: extinction [1/m] in place of
// the file's. Throws as load_scene() does.
GltfScene load_gltf(const std::string& path, std::optional<double> fog, Progress&);

// The notes alone; empty for files that are no glTF by their names' ends. Throws where the JSON of one is damaged.
std::vector<std::string> gltf_notes(const std::string& path);

// Base colour, metalness and roughness as Lambert and Phong lobes: a share F0 = 0.04 (1 - metallic) + base metallic is mirrored,
// base (1 - metallic) of the rest is diffuse. The lobe about the mirror direction has a quarter of the exponent 2 / roughness^4 -
// 2 of one about the half vector (Walter et al. 2007 of roughness^2 as the width).
Material gltf_material(const glm::dvec3& base, double metallic, double roughness);

// The keys of a scene file that may stand in the extras.
void parse_gltf_settings(const Node&, SceneFiles&, Loading&, Progress&);

}  // namespace airlight
