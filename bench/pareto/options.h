// The command line of airlight-pareto.
#pragma once

#include <string>
#include <vector>

#include "bench/pareto/measure.h"
#include "common/techniques/goal.h"

namespace airlight {

struct Options {
  std::vector<std::string> scenes;
  MeasureOptions measure;
  std::optional<Extent> resolution;  // instead of each camera's
  Settings truth;                    // knobs of the reference
  std::string out = "build/bench/pareto", cache = "build/bench/truth";
  double limit = 1e30;  // [s] for all scenes together
  Goal goal;
};

// Nothing where --help was asked for and has been printed. Throws InputError.
std::optional<Options> options_of(int argc, char** argv);

// What stands for a scene in the names of its files: no folder, no extension.
std::string stem_of(const std::string& scene);

}  // namespace airlight
