// What the program says while it works, and how it is stopped.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

#include "common/progress.h"

namespace airlight {

enum class LogLevel { error, warning, info, debug };

// Log lines and a progress line on standard error; the latter only where that is a terminal.
class Terminal final : public Progress {
 public:
  explicit Terminal(LogLevel);
  ~Terminal() override;

  void report(std::string_view what, double fraction) override;
  bool stop_requested() const override { return stop_.load(std::memory_order_relaxed); }
  bool logs(LogLevel level) const { return level <= level_; }
  void log(LogLevel, const std::string& line);
  void stop() { stop_.store(true, std::memory_order_relaxed); }

 private:
  void clear_line();

  LogLevel level_;
  bool shows_progress_;
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  bool line_is_open_ = false;
  std::chrono::steady_clock::time_point last_{};
};

// Call before any other thread exists. SIGINT and SIGTERM then set `stop`, and end the program with code 130 after 0.15 s if it
// has not ended by itself, temporary files removed.
void stop_on_signals(Terminal&);

}  // namespace airlight
