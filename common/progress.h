// How long work reports where it is, and how it learns that it should stop.
#pragma once

#include <string_view>

#include "common/error.h"

namespace airlight {

// Implemented by the caller. Both calls may come from any thread, at most a few hundred times a second.
class Progress {
 public:
  virtual ~Progress() = default;
  // `fraction` in 0..1 of the work named `what`.
  virtual void report(std::string_view what, double fraction) = 0;
  virtual bool stop_requested() const = 0;

  void check() const {
    if (stop_requested()) throw Interrupted();
  }
};

// Reports nowhere and never stops.
class NoProgress final : public Progress {
 public:
  void report(std::string_view, double) override {}
  bool stop_requested() const override { return false; }
};

}  // namespace airlight
