// What can be set of a technique.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace airlight {

// Declared once by the technique that has it; serves --set, --help, --explain and the sweeps of the benchmarks.
struct Knob {
  enum class Kind { integer, number, choice };
  std::string_view name;
  Kind kind = Kind::number;
  std::string_view standard;              // default value, as one would write it
  double least = 0, most = 0;             // integer and number
  std::vector<std::string_view> choices;  // choice
  std::string_view meaning;
  std::vector<std::string_view> sweep;  // values for time against error, coarse to fine
  // Choices that are measured beside the sweep, or the standard where there is none, for comparison: no goal takes them.
  std::vector<std::string_view> baselines = {};
};

// `least` and `most` may be set.
Knob integer_knob(std::string_view name, std::string_view standard, double least, double most, std::string_view meaning,
                  std::vector<std::string_view> sweep = {});
Knob number_knob(std::string_view name, std::string_view standard, double least, double most, std::string_view meaning,
                 std::vector<std::string_view> sweep = {});
// The first of the choices is the standard.
Knob choice_knob(std::string_view name, std::vector<std::string_view> choices, std::string_view meaning,
                 std::vector<std::string_view> sweep = {}, std::vector<std::string_view> baselines = {});

// The values of a technique's knobs. Throws InputError for an unknown knob (with a suggestion), a value out of its range.
class KnobValues {
 public:
  KnobValues() = default;
  KnobValues(std::span<const Knob> knobs, std::span<const std::pair<std::string, std::string>> set);
  double number(std::string_view name) const;
  std::string_view choice(std::string_view name) const;
  // name, value for every knob in order of declaration.
  const std::vector<std::pair<std::string, std::string>>& all() const { return values_; }

 private:
  const std::string& text(std::string_view name) const;
  std::vector<std::pair<std::string, std::string>> values_;
};

}  // namespace airlight
