// Where figures come from.
#pragma once

#include <map>
#include <string>

#include "common/image.h"

namespace airlight {

// What stands at the head of a file of measurements. No name of a host, no date: the same run twice gives the same head.
struct Origin {
  std::string scene;
  Extent extent, truth_extent;
  std::map<std::string, std::string> truth_knobs;
  std::string version, commit, compiler, machine;
};

// Fills in the last line of the struct: of the program, its sources, its compiler and this machine.
void add_machine(Origin&);

}  // namespace airlight
