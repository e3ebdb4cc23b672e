// A limit on the whole of a measurement, as a progress that stops.
#pragma once

#include <chrono>

#include "common/progress.h"

namespace airlight {

// Reports where another one does, and asks to stop when that one does or when its time is over.
class Deadline final : public Progress {
 public:
  Deadline(Progress& inner, double seconds) : inner_(inner), end_(Clock::now() + duration_of(seconds)) {}

  void report(std::string_view what, double fraction) override { inner_.report(what, fraction); }
  bool stop_requested() const override { return inner_.stop_requested() || passed(); }
  bool passed() const { return Clock::now() >= end_; }

 private:
  using Clock = std::chrono::steady_clock;
  static Clock::duration duration_of(double seconds) {
    constexpr double longest = 1e8;  // three years: what the clock's integers hold, and no limit in practice
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds < longest ? seconds : longest));
  }

  Progress& inner_;
  Clock::time_point end_;
};

}  // namespace airlight
