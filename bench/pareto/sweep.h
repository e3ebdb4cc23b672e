// What is measured: every technique that renders a scene, on each backend, with every product of its knobs' sweeps and baselines.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "common/image.h"
#include "common/scene/scene.h"
#include "common/techniques/choose.h"

namespace airlight {

struct Configuration {
  std::string technique, backend;
  Settings knobs;  // those with a sweep

  // Every knob of the technique, those without a sweep at their standard: a scene's own settings do not count.
  Settings all_knobs() const;
};

// Those of one technique that differ in their plan: a knob that the scene does not need is not swept. `refused` gets why settings
// are left out that the technique refuses for the scene.
std::vector<Settings> different_settings(const Technique&, const Scene&, Extent, std::set<std::string>& refused);

// Of the real-time techniques named (all, where none is), those that render the scene, with each backend in turn. `refused`
// gets a line "technique: why" for each of the others, and for settings that one of them refuses.
std::vector<Configuration> configurations(const Scene&, Extent, const std::vector<std::string>& techniques,
                                          const std::vector<std::string>& backends, std::vector<std::string>& refused);

// "steps=32 light_steps=16"
std::string text_of(const Settings&);

}  // namespace airlight
