// The scenes that techniques are held to the truth on, and whose true images are stored in tests/data/truth.
#pragma once

#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "common/image.h"
#include "common/reference/pixel.h"
#include "common/scene/scene.h"

namespace airlight {

struct TruthScene {
  std::string_view name;
  Scene (*make)();
};
// For the names of tests.
inline void PrintTo(const TruthScene& scene, std::ostream* out) { *out << scene.name; }

// Homogeneous fog, which `shadow-planes` renders.
std::span<const TruthScene> homogeneous_scenes();

// The homogeneous part, two Gaussians and a box that throws a shadow into them.
Scene gaussians_behind_box();

// Five Gaussians, thin and dense, one of them glowing, in thin fog; a lamp among them, and the sun.
Scene lamp_in_gaussians();

// What tests/data/truth holds, with shadows.
std::span<const TruthScene> stored_scenes();
inline constexpr Extent stored_extent{96, 72};
inline constexpr ReferenceSettings stored_settings{1e-9, true};

}  // namespace airlight
