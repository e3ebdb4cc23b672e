#include "app/request.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/spelling.h"

namespace airlight {

// What the settings ask for: by name, by the scene, or the first that supports it.
const Technique& chosen_technique(const Scene& scene, const RenderSettings& settings) {
  const bool open = settings.technique == "auto";
  const std::string& name = open ? scene.technique : settings.technique;
  if (!name.empty() && name != "auto") {
    const Technique& t = technique(name);
    if (const auto why = t.refuses(scene)) throw InputError("technique " + name + " cannot render this scene: " + *why);
    return t;
  }
  std::string reasons;
  for (const Technique& t : techniques()) {
    if (!t.plan) continue;
    const auto why = t.refuses(scene);
    if (!why) return t;
    reasons += "; " + std::string(t.name) + ": " + *why;
  }
  const bool reference = !technique("reference").refuses(scene);
  throw InputError(std::string("no real-time technique of this version renders this scene") +
                   (reference ? " (reference does)" : "") + reasons);
}

FrameRequest request_for(const Technique& technique, const Scene& scene, const RenderSettings& settings) {
  FrameRequest request;
  request.extent = settings.resolution.value_or(scene.camera.resolution);
  if (request.extent.width < 1 || request.extent.width > 65535 || request.extent.height < 1 || request.extent.height > 65535) {
    throw InputError("resolution: expected 1..65535 pixels a side");
  }
  if (settings.supersample < 1 || settings.supersample > 16) throw InputError("supersample: expected 1..16");
  auto knobs = technique.name == scene.technique ? scene.settings : decltype(scene.settings)();
  knobs.insert(knobs.end(), settings.knobs.begin(), settings.knobs.end());
  if (within(settings.rows, request.extent.height).count() == 0) throw InputError("rows: the image has none of them");
  request.knobs = KnobValues(technique.knobs, knobs);

  const std::vector<std::string> names = image_names(scene);
  std::vector<std::string_view> known(names.begin(), names.end());
  known.insert(known.end(), technique.own_images.begin(), technique.own_images.end());
  for (const std::string& name : settings.images) {
    for (const Technique& t : techniques()) {
      const auto& own = t.own_images;
      if (t.name != technique.name && std::find(own.begin(), own.end(), name) != own.end())
        throw InputError("image " + name + ": only technique " + std::string(t.name) + " gives it");
    }
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError("unknown image \"" + name + "\"" + suggestion(name, known));
    }
    request.images.insert(name);
  }
  return request;
}

}  // namespace airlight
