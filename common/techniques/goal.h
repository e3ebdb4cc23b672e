// What a user may ask of a frame instead of knobs: how near to the truth, or how fast.
#pragma once

#include <optional>
#include <string>

namespace airlight {

// At most one of the two.
struct Goal {
  std::optional<double> error;    // relative RMSE, > 0
  std::optional<double> seconds;  // a warm frame, > 0

  explicit operator bool() const { return error || seconds; }
};

// From the texts of --error ("1%", "0.01") and --budget ("30ms", "0.03s"), each only if it is asked. Throws InputError for
// anything else, and for both.
Goal goal_of(const std::optional<std::string>& error, const std::optional<std::string>& budget);

}  // namespace airlight
