// Names of files that have the number of a frame in them: smoke_####.vdb.
#pragma once

#include <string>
#include <string_view>

namespace airlight {

inline constexpr int last_frame = 999999;  // frames are numbered from 0

// Whether there is a # in it: the last run of them stands for the number.
bool has_frame_pattern(std::string_view name);

// The name with the number in place of that run, with zeros before it to the run's length; the name itself without one.
std::string with_frame(std::string_view name, int frame);

}  // namespace airlight
