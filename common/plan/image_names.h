// How the images are called that techniques give.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/scene.h"

namespace airlight {

// Every image that any technique gives of the scene: beauty surface surface.direct surface.indirect surface.ambient transmittance
// airlight airlight.<light> depth normal optical_depth, with an environment surface.environment. airlight.<light> is by the
// light's name, else its index from 0.
std::vector<std::string> image_names(const Scene&);
std::string light_image_name(const Scene&, std::size_t light);
int image_channels(std::string_view name);

}  // namespace airlight
