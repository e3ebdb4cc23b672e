// Scene files (JSON with comments, version 1) into scenes.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "common/progress.h"
#include "common/scene/scene.h"

namespace airlight {

// Loads a scene file and every file that it names (paths are relative to the scene file). Throws InputError with
// "file:line:column: what is wrong, what was expected" for bad content, for a key or type of a later version by its name, for
// limits (2^31 indices, 50 million triangles, 2^29 cells of a grid, 65535 pixels a side), before allocating for them.
Scene load_scene(const std::string& path, Progress&);
Scene load_scene(const std::string& path);

// The same from text; `name` stands for the file in messages, `directory` is where relative paths start.
Scene parse_scene(std::string_view text, const std::string& name, const std::string& directory, Progress&);

// A mesh file (what assimp reads), all its triangles in one mesh, node transforms applied. Normals: the file's, unless `flat`
// or absent; generated ones are smooth below a crease angle of 60 degrees.
std::shared_ptr<const Mesh> load_mesh(const std::string& path, bool flat, Progress&);

}  // namespace airlight
