#include "common/techniques/choose.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "common/error.h"

namespace airlight {

// What the environment's light adds to an error (tests/truth/environment.cpp): harmonics leave little of matt surfaces and of
// fog, what surfaces hide of it leaves more (environment_shadows.cpp there). Narrow lobes, tabulated reflectances and other media
// are not promised.
static double environment_error(const Scene& scene, const KnobValues& knobs) {
  if (!scene.environment) return 0;
  if (!scene.medium.gaussians.empty() || scene.medium.grid) return std::numeric_limits<double>::infinity();
  const bool hidden = std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [](const Surface& s) { return s.casts_shadow; });
  if (hidden && knobs.choice("environment_shadows") == "off") return std::numeric_limits<double>::infinity();
  double error = hidden ? 0.03 : scene.medium.extinction > 0 ? 0.015 : 0.002;
  for (const Surface& s : scene.surfaces) {
    if (s.brdf) return std::numeric_limits<double>::infinity();
    if (s.material.specular == glm::vec3(0)) continue;
    error = std::max(error, s.material.shininess > 40 ? std::numeric_limits<double>::infinity() : hidden ? 0.06 : 0.03);
  }
  return error;
}

std::vector<Settings> products(std::span<const Knob> knobs, bool baselines) {
  std::vector<Settings> all{{}};
  for (const Knob& knob : knobs) {
    std::vector<std::string_view> values = knob.sweep;
    if (baselines && !knob.baselines.empty()) {
      if (values.empty()) values = {knob.standard};
      values.insert(values.end(), knob.baselines.begin(), knob.baselines.end());
    }
    if (values.empty()) continue;
    std::vector<Settings> longer;
    for (const Settings& settings : all) {
      for (const std::string_view value : values) {
        longer.push_back(settings);
        longer.back().emplace_back(knob.name, value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::string Choice::text() const {
  std::string all = technique;
  for (const auto& [name, value] : settings) all += " " + name + "=" + value;
  char expected[80];
  std::snprintf(expected, sizeof expected, ": %.2g %% and %.2g ms expected", 100 * estimate.error, 1e3 * estimate.seconds);
  return all + expected;
}

Choice choose(const Scene& scene, Extent extent, const Goal& goal, std::string_view only, int threads) {
  Choice best, nearest;
  std::string reasons;
  // First what misses the goal least, then what costs least.
  const auto cost = [&](const Estimate& e) { return goal.error ? e.seconds : e.error; };
  const auto missed = [&](const Estimate& e) { return goal.error ? e.error / *goal.error : e.seconds / *goal.seconds; };
  for (const Technique& t : techniques()) {
    if (!t.estimate || (!only.empty() && t.name != only)) continue;
    if (const auto why = t.refuses(scene)) {
      reasons += "; " + std::string(t.name) + ": " + *why;
      continue;
    }
    bool known = false;
    for (const Settings& settings : products(t.knobs)) {
      Settings all = t.name == scene.technique ? scene.settings : Settings();  // they hold where the goal has none
      all.insert(all.end(), settings.begin(), settings.end());
      const KnobValues knobs(t.knobs, all);
      Estimate e = t.estimate(scene, extent, knobs, threads);
      e.error += environment_error(scene, knobs);
      if (!std::isfinite(e.error)) continue;
      known = true;
      if (nearest.technique.empty() || missed(e) < missed(nearest.estimate)) nearest = {std::string(t.name), settings, e};
      if (missed(e) <= 1 && (best.technique.empty() || cost(e) < cost(best.estimate))) best = {std::string(t.name), settings, e};
    }
    if (!known) reasons += "; " + std::string(t.name) + ": how large its error is with the scene's settings is not known";
  }
  if (!best.technique.empty()) return best;
  throw InputError("no technique of this version is expected to meet the goal" +
                   (nearest.technique.empty() ? std::string() : "; nearest is " + nearest.text()) + reasons);
}

}  // namespace airlight
