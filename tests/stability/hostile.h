// Scenes that are valid and hostile: each is an ordinary one, made of a number, with a few things at the ends of what is allowed.
#pragma once

#include <cstdint>
#include <string>

#include "common/scene/scene.h"

namespace airlight {

struct HostileScene {
  Scene scene;         // 24 x 16 pixels unless the traits tell of others
  std::string traits;  // what is hostile in it, for messages: "lamp on a view ray, slivers"
};

HostileScene hostile_scene(std::uint32_t number);

}  // namespace airlight
