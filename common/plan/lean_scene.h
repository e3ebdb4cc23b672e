// A scene without the Gaussians that change nothing, which every plan begins with.
#pragma once

#include <cstddef>
#include <memory>

#include "common/scene/scene.h"

namespace airlight {

struct LeanScene {
  // The scene given where all of its Gaussians are needed: it must outlive this then.
  std::shared_ptr<const Scene> scene;
  std::size_t empty = 0;       // Gaussians of zero extinction, left out
  std::size_t coincident = 0;  // and those added to one before them, of the same centre and radius
};

// Extinctions and emissions add up where Gaussians lie on each other, albedos weigh as the extinctions: the same medium to
// rounding in double. Order is kept.
LeanScene lean_scene(const Scene&);

}  // namespace airlight
