#include "bench/pareto/sweep.h"

#include <map>
#include <set>

#include "common/plan/keys.h"

namespace airlight {

std::vector<Settings> different_settings(const Technique& technique, const Scene& scene, Extent extent) {
  std::set<std::vector<std::uint64_t>> seen;
  std::vector<Settings> different;
  for (const Settings& settings : products(technique.knobs)) {
    FrameRequest request;
    request.extent = extent;
    request.images = {"beauty"};
    request.knobs = KnobValues(technique.knobs, settings);
    const Plan plan = technique.plan(scene, request);
    std::map<Handle, std::uint64_t> uploads;
    for (const Plan::Upload& upload : plan.uploads) uploads[upload.buffer] = upload.key;
    if (seen.insert(step_keys(plan.steps, [&](Handle h) { return uploads.at(h); })).second) different.push_back(settings);
  }
  return different;
}

std::string text_of(const Settings& settings) {
  std::string text;
  for (const auto& [name, value] : settings) text += (text.empty() ? "" : " ") + name + "=" + value;
  return text;
}

}  // namespace airlight
