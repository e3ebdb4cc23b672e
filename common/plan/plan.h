// What a technique makes of a scene: a list of steps that any backend can run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "common/algorithms/algorithm.h"
#include "common/plan/knobs.h"
#include "common/plan/rules.h"

namespace airlight {

class TransferSource;  // common/plan/surface_transfer.h

// One pass over the image: extent, sub-pixel shift, and the images wanted.
struct FrameRequest {
  Extent extent;
  glm::dvec2 offset{0, 0};       // [pixel] of the sample from the pixel centre
  std::set<std::string> images;  // names as in aov_names(), "beauty" among them where wanted
  KnobValues knobs;
  std::shared_ptr<TransferSource> transfer = {};  // asked by uploads alone; none for plans whose uploads are not made
  // By place of the light in the scene (common/plan/light_slots.h): tells apart handles of what belongs to each. Empty: its
  // place.
  std::vector<std::uint32_t> light_slots = {};
};

struct Plan {
  struct Upload {
    Buffer buffer;
    std::uint64_t key = 0;                         // names the content
    std::function<std::vector<std::byte>()> make;  // called only when no backend holds it under this key
    std::function<std::uint64_t()> most = {};      // [byte] that it makes at most, where `buffer` does not tell
  };
  struct Skip {
    Rule rule;
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

}  // namespace airlight
