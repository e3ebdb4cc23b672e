#include "common/scene/frame_pattern.h"

#include <fmt/format.h>

namespace airlight {

bool has_frame_pattern(std::string_view name) { return name.find('#') != name.npos; }

std::string with_frame(std::string_view name, int frame) {
  const std::size_t last = name.rfind('#');
  if (last == name.npos) return std::string(name);
  const std::size_t before = name.find_last_not_of('#', last);  // npos + 1 is 0
  return fmt::format("{}{:0{}}{}", name.substr(0, before + 1), frame, last - before, name.substr(last + 1));
}

}  // namespace airlight
