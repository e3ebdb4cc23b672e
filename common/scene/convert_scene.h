// Other files as scene files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/progress.h"

namespace airlight {

struct ConvertedScene {
  std::string json;                // a scene file, which names the meshes of the file that it comes from
  std::vector<std::string> notes;  // what of that is not in it, a line each
};

// A glTF file as the scene file that has the same hash and the same pictures, or a mesh as a scene that shows it under a sun.
// Paths in it are relative to `folder`, where it will stand. `fog`: extinction [1/m] in place of the file's. Throws as
// load_scene() does.
ConvertedScene convert_scene(const std::string& path, const std::string& folder, std::optional<double> fog, Progress&);

}  // namespace airlight
