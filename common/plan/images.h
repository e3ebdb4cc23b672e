// The images of a plan: which are kept, which are only handed on.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "common/scene/scene.h"
#include "common/techniques/technique.h"

namespace airlight {

// Names images as they are wanted: a wanted one is kept, any other is transient.
class Images {
 public:
  Images(const FrameRequest& request, Plan& plan, std::uint32_t first_id) : request_(request), plan_(plan), next_id_(first_id) {}

  Image make(std::string_view name, Format format) {
    Image image{{next_id_++}, format, request_.extent, 1, wanted(name)};
    if (image.keep) plan_.outputs.push_back({std::string(name), image, 0});
    return image;
  }
  // Absent unless it is wanted.
  Image optional(std::string_view name, Format format) {
    if (wanted(name)) return make(name, format);
    ++next_id_;  // ids do not depend on what is wanted
    return {};
  }
  bool wanted(std::string_view name) const { return request_.images.contains(std::string(name)); }

 private:
  const FrameRequest& request_;
  Plan& plan_;
  std::uint32_t next_id_;
};

// One image with a layer a light (`lights`: their positions in the scene), where any of them is wanted; else absent.
Image per_light_images(const Scene&, const FrameRequest&, const std::vector<std::size_t>& lights, std::uint32_t id, Plan&);

}  // namespace airlight
