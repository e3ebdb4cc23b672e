// A technique is a pure function from a scene and its settings to a plan: a list of steps that any backend can run.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/plan/image_names.h"
#include "common/plan/plan.h"
#include "common/scene/scene.h"

namespace airlight {

// What a frame is expected to be like before it is rendered: by a stored model, conservative in the error; see the technique's
// file.
struct Estimate {
  double error = 0;    // relative RMSE of beauty; infinite: nothing is promised
  double seconds = 0;  // of a warm frame on the CPU of docs/RESULTS.md
};

struct Technique {
  std::string_view name;
  std::string_view summary;
  std::vector<Knob> knobs;
  std::vector<std::string_view> own_images = {};  // that no other gives
  bool multiple_scattering = false;               // it renders orders above the first, which the truth of sweeps has not
  // Why this technique cannot render the scene, or nothing.
  std::optional<std::string> (*refuses)(const Scene&) = nullptr;
  Plan (*plan)(const Scene&, const FrameRequest&) = nullptr;  // null for `reference`, which runs on no backend
  Estimate (*estimate)(const Scene&, Extent, const KnobValues&, int threads) = nullptr;  // null for `reference`
};

// All techniques that work, in the order of --help; `reference` last.
std::span<const Technique> techniques();
// Throws InputError naming the known ones.
const Technique& technique(std::string_view name);

}  // namespace airlight
