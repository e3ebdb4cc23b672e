// What steps pass over inside themselves, in words: for --stats.
#pragma once

#include <string_view>

#include "common/algorithms/algorithm.h"

namespace airlight {

struct StepSkips {
  std::string_view items;             // why it is done with an item before its work begins; empty: it never is
  std::string_view parts, why_parts;  // what else it works through, plural, and why of that something is passed over
};
StepSkips step_skips(const Algorithm&);

}  // namespace airlight
