// The parts of a scene file, each from its JSON value to its struct. All throw InputError with the place.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/scene/reader.h"
#include "common/scene/scene.h"
#include "common/scene/scene_files.h"

namespace airlight {

Camera parse_camera(const Node&);
// From `transform`, or from `translate`, `rotate` and the key that is named `factor`.
glm::dmat4 parse_transform(const Object&, std::string_view factor);
// Whether the linear part is no more than rounding away from one without an inverse; also for NaN.
bool singular(const glm::dmat4&);
Material parse_material(const Node&);

// A scene with what its hash needs beyond the value.
struct LoadedSurface {
  std::string content_hash;
  bool flat = false;
  std::string brdf_hash;  // of the file that the material names
  int part = -1;          // which material's triangles of the file; -1: all
};
struct Loading {
  Scene scene;
  std::vector<LoadedSurface> surfaces;  // one a surface
  std::string grid_hash, grid_name;     // of the medium's grid: its file's bytes, its name there
  std::string environment_hash;         // of the environment's image: its file's bytes
};

// Where files are not read, what comes of them is missing, and so are surfaces.

// Into scene.lights and scene.environment.
void parse_lights(const Node&, SceneFiles&, Loading&);

// Into scene.medium.
void parse_medium(const Node&, SceneFiles&, Loading&, Progress&);

// Onto medium.gaussians, with the medium's albedo and emission where they have none of their own.
void parse_gaussians(const Node&, Medium&);
void parse_gaussians_file(const Node&, SceneFiles&, Medium&, Progress&);

Noise parse_noise(const Node&);

void parse_surfaces(const Node&, SceneFiles&, Loading&, Progress&);

// SHA-256 over every value (defaults filled in, in a fixed order) and the hashes of the files.
std::string scene_hash(const Loading&);

// Name of the technique and its knobs, into scene.technique and scene.settings.
void parse_technique(const Node&, Scene&);

}  // namespace airlight
