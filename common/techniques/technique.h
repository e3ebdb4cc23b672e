// A technique is a pure function from a scene and its settings to a plan: a list of steps that any backend can run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/algorithms/algorithm.h"
#include "common/scene/scene.h"

namespace airlight {

// Declared once by its technique; serves --set, --help, --explain and the sweeps of the benchmarks.
struct Knob {
  enum class Kind { integer, number, choice };
  std::string_view name;
  Kind kind = Kind::number;
  std::string_view standard;              // default value, as one would write it
  double least = 0, most = 0;             // integer and number
  std::vector<std::string_view> choices;  // choice
  std::string_view meaning;
  std::vector<std::string_view> sweep;  // values for time against error, coarse to fine
  // Choices that are measured beside the sweep, or the standard where there is none, for comparison: no goal takes them.
  std::vector<std::string_view> baselines = {};
};

// The values of a technique's knobs. Throws InputError for an unknown knob (with a suggestion), a value out of its range.
class KnobValues {
 public:
  KnobValues() = default;
  KnobValues(std::span<const Knob> knobs, std::span<const std::pair<std::string, std::string>> set);
  double number(std::string_view name) const;
  std::string_view choice(std::string_view name) const;
  // name, value for every knob in order of declaration.
  const std::vector<std::pair<std::string, std::string>>& all() const { return values_; }

 private:
  const std::string& text(std::string_view name) const;
  std::vector<std::pair<std::string, std::string>> values_;
};

// One pass over the image: extent, sub-pixel shift, and the images wanted.
struct FrameRequest {
  Extent extent;
  glm::dvec2 offset{0, 0};       // [pixel] of the sample from the pixel centre
  std::set<std::string> images;  // names as in aov_names(), "beauty" among them where wanted
  KnobValues knobs;
};

struct Plan {
  struct Upload {
    Buffer buffer;
    std::uint64_t key = 0;                         // names the content
    std::function<std::vector<std::byte>()> make;  // called only when no backend holds it under this key
  };
  struct Skip {
    std::string what, why;
  };
  struct Output {
    std::string name;
    Image image;
    int layer = 0;
  };
  std::vector<Upload> uploads;
  std::vector<Step> steps;
  std::vector<Skip> skips;
  std::vector<Output> outputs;  // the wanted images, each kept
};

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

// Every image that any technique gives of the scene: beauty surface surface.direct surface.indirect surface.ambient transmittance
// airlight airlight.<light> depth normal optical_depth, with an environment surface.environment. airlight.<light> is by the
// light's name, else its index from 0.
std::vector<std::string> image_names(const Scene&);
std::string light_image_name(const Scene&, std::size_t light);
int image_channels(std::string_view name);

}  // namespace airlight
