#include "common/plan/knobs.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "common/error.h"
#include "common/spelling.h"

namespace airlight {

namespace {

std::string number_text(double v) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, v).ptr;
  return {text, end};
}

// One line that says what the knob takes.
std::string range_text(const Knob& knob) {
  if (knob.kind == Knob::Kind::choice) return joined(knob.choices, " | ");
  return std::string(knob.kind == Knob::Kind::integer ? "an integer" : "a number") + " in " + number_text(knob.least) + ".." +
         number_text(knob.most);
}

bool fits(const Knob& knob, const std::string& value) {
  if (knob.kind == Knob::Kind::choice) {
    return std::find(knob.choices.begin(), knob.choices.end(), value) != knob.choices.end();
  }
  double v = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), v);
  if (error != std::errc() || end != value.data() + value.size()) return false;
  if (knob.kind == Knob::Kind::integer && v != std::floor(v)) return false;
  return v >= knob.least && v <= knob.most;  // false for NaN
}

}  // namespace

Knob integer_knob(std::string_view name, std::string_view standard, double least, double most, std::string_view meaning,
                  std::vector<std::string_view> sweep) {
  return {name, Knob::Kind::integer, standard, least, most, {}, meaning, std::move(sweep)};
}

Knob number_knob(std::string_view name, std::string_view standard, double least, double most, std::string_view meaning,
                 std::vector<std::string_view> sweep) {
  return {name, Knob::Kind::number, standard, least, most, {}, meaning, std::move(sweep)};
}

Knob choice_knob(std::string_view name, std::vector<std::string_view> choices, std::string_view meaning,
                 std::vector<std::string_view> sweep, std::vector<std::string_view> baselines) {
  const std::string_view standard = choices.front();
  return {name, Knob::Kind::choice, standard, 0, 0, std::move(choices), meaning, std::move(sweep), std::move(baselines)};
}

KnobValues::KnobValues(std::span<const Knob> knobs, std::span<const std::pair<std::string, std::string>> set) {
  for (const Knob& knob : knobs) values_.emplace_back(knob.name, knob.standard);
  for (const auto& setting : set) {
    const std::string& name = setting.first;
    const std::string& value = setting.second;
    const auto knob = std::find_if(knobs.begin(), knobs.end(), [&](const Knob& k) { return k.name == name; });
    if (knob == knobs.end()) {
      std::vector<std::string_view> known;
      for (const Knob& k : knobs) known.push_back(k.name);
      throw InputError("unknown setting \"" + name + "\"" + suggestion(name, known));
    }
    if (!fits(*knob, value)) {
      throw InputError("setting " + name + ": expected " + range_text(*knob) + ", found \"" + value + "\"");
    }
    values_[static_cast<std::size_t>(knob - knobs.begin())].second = value;
  }
}

const std::string& KnobValues::text(std::string_view name) const {
  for (const auto& [known, value] : values_) {
    if (known == name) return value;
  }
  throw std::logic_error("no such knob: " + std::string(name));
}

double KnobValues::number(std::string_view name) const {
  const std::string& value = text(name);
  double v = 0;
  std::from_chars(value.data(), value.data() + value.size(), v);
  return v;
}

std::string_view KnobValues::choice(std::string_view name) const { return text(name); }

}  // namespace airlight
