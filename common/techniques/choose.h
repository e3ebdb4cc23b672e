// Technique and knobs for a goal, by each technique's stored estimate.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/techniques/goal.h"
#include "common/techniques/technique.h"

namespace airlight {

using Settings = std::vector<std::pair<std::string, std::string>>;  // knob, value

// Products of the knobs' sweeps, the first knob slowest; knobs without a sweep are left at their standard. With `baselines` a
// knob has these, too, beside its sweep or its standard.
std::vector<Settings> products(std::span<const Knob>, bool baselines = false);

struct Choice {
  std::string technique;
  Settings settings;
  Estimate estimate;

  // "marching steps=16 shadow=analytic: 0.4 % and 35 ms expected"
  std::string text() const;
};

// With at most the goal's error the fastest, or within its time the most exact; among all techniques or, unless `only` is empty,
// one. Throws InputError where nothing is expected to meet the goal, and says what comes nearest.
Choice choose(const Scene&, Extent, const Goal&, std::string_view only, int threads);

}  // namespace airlight
