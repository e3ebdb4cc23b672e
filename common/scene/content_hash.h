// What a scene's image depends on, as a name.
#pragma once

#include <string>

#include "common/scene/scene.h"

namespace airlight {

// SHA-256 (hex) of everything in a scene that its image depends on, meshes and grids included; neither its resolution, nor its
// lights' names, nor the technique that it asks for. Also of scenes built in code, which have no Scene::hash.
std::string content_hash(const Scene&);

}  // namespace airlight
