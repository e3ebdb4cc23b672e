#include "common/techniques/goal.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "common/error.h"

namespace airlight {

namespace {

// A positive number with one of two units; the factor of the one it has.
double positive(const std::string& text, std::string_view unit, double factor, std::string_view other, double other_factor,
                const std::string& expected) {
  double v = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, v);
  const std::string_view given(rest, static_cast<std::size_t>(end - rest));
  const double scale = given == unit ? factor : given == other ? other_factor : 0;
  const double value = v * scale;
  if (error != std::errc() || !(value > 0) || !std::isfinite(value)) throw InputError(expected + ", found \"" + text + "\"");
  return value;
}

}  // namespace

Goal goal_of(const std::optional<std::string>& error, const std::optional<std::string>& budget) {
  if (error && budget) throw InputError("--error and --budget: expected one of them");
  Goal goal;
  if (error) goal.error = positive(*error, "%", 0.01, "", 1, "--error: expected a relative error such as 1% or 0.01");
  if (budget) goal.seconds = positive(*budget, "ms", 1e-3, "s", 1, "--budget: expected a time such as 30ms or 0.03s");
  return goal;
}

}  // namespace airlight
