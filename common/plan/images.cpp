#include "common/plan/images.h"

#include <algorithm>

namespace airlight {

Image per_light_images(const Scene& scene, const FrameRequest& request, const std::vector<std::size_t>& lights, std::uint32_t id,
                       Plan& plan) {
  Image image{{id}, Format::rgb32f, request.extent, std::max(1, static_cast<int>(lights.size())), true};
  bool any = false;
  for (std::size_t layer = 0; layer < lights.size(); ++layer) {
    const std::string name = light_image_name(scene, lights[layer]);
    if (!request.images.contains(name)) continue;
    plan.outputs.push_back({name, image, static_cast<int>(layer)});
    any = true;
  }
  return any ? image : Image{};
}

}  // namespace airlight
