#pragma once

#include <memory>
#include <string>

#include "common/scene/scene.h"
#include "tests/stability/draw.h"

namespace airlight {

// A mesh about the origin, about as large as a unit box; `trait` tells what is hostile in it, if anything.
std::shared_ptr<const Mesh> hostile_mesh(Draw&, std::string& trait);

}  // namespace airlight
