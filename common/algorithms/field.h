// How an algorithm tells its fields, once, for keys, --explain, case names and checks.
#pragma once

#include <string_view>

namespace airlight {

enum class Role { input, output, knob };

struct Field {
  std::string_view name;
  std::string_view unit;  // "" when dimensionless
  Role role;
};

constexpr Field in(std::string_view name, std::string_view unit = "") { return {name, unit, Role::input}; }
constexpr Field out(std::string_view name, std::string_view unit = "") { return {name, unit, Role::output}; }
constexpr Field knob(std::string_view name, std::string_view unit = "") { return {name, unit, Role::knob}; }

// pixel: of images as large as those that it makes it reads only its own pixel, so that consecutive steps may be run tile by
// tile; smaller or larger ones it may read anywhere. screen: everything else that makes screen images; volume: makes buffers,
// and no image.
enum class Domain { pixel, screen, volume };

}  // namespace airlight
