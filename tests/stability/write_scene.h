// A scene made in code as files that the program renders: scene.json, its meshes, grid and sky.
#pragma once

#include <string>

#include "common/scene/scene.h"
#include "common/techniques/choose.h"

namespace airlight {

// Into an existing folder. `technique` and its settings go into the file, too. Tabulated reflectances are left out.
void write_scene(const std::string& folder, const Scene&, const std::string& technique, const Settings&);

}  // namespace airlight
