#include "bench/pareto/sweep.h"

#include <algorithm>
#include <map>

#include "common/error.h"
#include "common/plan/keys.h"

namespace airlight {

Settings Configuration::all_knobs() const { return KnobValues(airlight::technique(technique).knobs, knobs).all(); }

std::vector<Settings> different_settings(const Technique& technique, const Scene& scene, Extent extent,
                                         std::set<std::string>& refused) {
  std::set<std::vector<std::uint64_t>> seen;
  std::vector<Settings> different;
  for (const Settings& settings : products(technique.knobs, true)) {
    FrameRequest request;
    request.extent = extent;
    request.images = {"beauty"};
    request.knobs = KnobValues(technique.knobs, settings);
    try {
      const Plan plan = technique.plan(scene, request);
      std::map<Handle, std::uint64_t> uploads;
      for (const Plan::Upload& upload : plan.uploads) uploads[upload.buffer] = upload.key;
      if (seen.insert(step_keys(plan.steps, [&](Handle h) { return uploads.at(h); })).second) different.push_back(settings);
    } catch (const InputError& e) {
      refused.insert(e.what());
    }
  }
  return different;
}

std::vector<Configuration> configurations(const Scene& scene, Extent extent, const std::vector<std::string>& asked,
                                          const std::vector<std::string>& backends, std::vector<std::string>& refused) {
  std::vector<Configuration> all;
  for (const Technique& t : techniques()) {
    if (!t.plan || (!asked.empty() && std::find(asked.begin(), asked.end(), t.name) == asked.end())) continue;
    if (const auto why = t.refuses(scene)) {
      refused.push_back(std::string(t.name) + ": " + *why);
      continue;
    }
    if (t.multiple_scattering) {
      refused.push_back(std::string(t.name) + ": it renders orders of scattering above the first, the truth has one");
      continue;
    }
    std::set<std::string> why;
    for (const Settings& settings : different_settings(t, scene, extent, why)) {
      for (const std::string& backend : backends) all.push_back({std::string(t.name), backend, settings});
    }
    for (const std::string& line : why) refused.push_back(std::string(t.name) + ": " + line);
  }
  return all;
}

std::string text_of(const Settings& settings) {
  std::string text;
  for (const auto& [name, value] : settings) text += (text.empty() ? "" : " ") + name + "=" + value;
  return text;
}

}  // namespace airlight
