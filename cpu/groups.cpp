#include "cpu/groups.h"

#include <algorithm>

#include "common/algorithms/each_field.h"

namespace airlight {

void Meanwhile::find_groups(std::span<const Step> steps, const std::vector<bool>& run, bool fuse) {
  running.clear(), groups.clear();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (run[i]) running.push_back(i);
  }
  for (std::size_t k = 0; k < running.size(); ++k) {
    const Algorithm& what = steps[running[k]].what;
    const StepRows& made = rows[running[k]];
    Extent extent;  // of all that it makes
    each_made<Image>(what, [&](const Image& image) { extent = image.extent; });
    const bool joins = fuse && !groups.empty() && domain_of(what) == Domain::pixel && groups.back().extent == extent &&
                       groups.back().rows.computed == made.computed;
    if (!joins) groups.push_back({std::span(running).subspan(k, 0), extent, made});
    groups.back().steps = std::span(groups.back().steps.data(), groups.back().steps.size() + 1);
  }
}

void Meanwhile::find_held(std::span<const Step> steps) {
  writers.clear(), held.clear();
  const auto hold = [&](const Image& image, Rows of) {
    std::erase_if(held, [&](const HeldPart& h) { return h.image.id == image.id; });
    held.push_back({image, of});
  };
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const std::size_t i : groups[g].steps) {
      each_input(steps[i].what, [&](Handle input) {
        const auto written = std::find_if(writers.rbegin(), writers.rend(), [&](const auto& w) { return w.first == input; });
        if (written == writers.rend() || written->second == g) return;
        const Group& writer = groups[written->second];
        for (const std::size_t j : writer.steps) {
          each_made<Image>(steps[j].what, [&](const Image& image) {
            if (image.id == input.id) hold(image, writer.rows.held);
          });
        }
      });
      each_made<Image>(steps[i].what, [&](const Image& image) {
        writers.emplace_back(image, g);
        if (image.keep) hold(image, groups[g].rows.held);
      });
    }
  }
}

}  // namespace airlight
