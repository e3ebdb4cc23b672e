// What is measured: every technique that renders a scene, on each backend, with every product of its knobs' sweeps.
#pragma once

#include <string>
#include <vector>

#include "common/image.h"
#include "common/scene/scene.h"
#include "common/techniques/choose.h"

namespace airlight {

struct Configuration {
  std::string technique, backend;
  Settings knobs;  // those with a sweep
};

// Those of one technique that differ in their plan: a knob that the scene does not need is not swept.
std::vector<Settings> different_settings(const Technique&, const Scene&, Extent);

// "steps=32 light_steps=16"
std::string text_of(const Settings&);

}  // namespace airlight
