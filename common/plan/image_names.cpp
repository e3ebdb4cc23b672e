#include "common/plan/image_names.h"

namespace airlight {

std::vector<std::string> image_names(const Scene& scene) {
  std::vector<std::string> names{"beauty",        "surface",  "surface.direct", "surface.indirect", "surface.ambient",
                                 "transmittance", "airlight", "depth",          "normal",           "optical_depth"};
  if (scene.environment) names.push_back("surface.environment");
  for (std::size_t i = 0; i < scene.lights.size(); ++i) names.push_back(light_image_name(scene, i));
  return names;
}

std::string light_image_name(const Scene& scene, std::size_t light) {
  const std::string& name = scene.lights.at(light).name;
  return "airlight." + (name.empty() ? std::to_string(light) : name);
}

int image_channels(std::string_view name) {
  return name == "transmittance" || name == "depth" || name == "optical_depth" ? 1 : 3;
}

}  // namespace airlight
