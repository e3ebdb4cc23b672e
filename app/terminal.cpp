#include "app/terminal.h"

#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <thread>

#include "common/scene/image_file.h"

namespace airlight {

Terminal::Terminal(LogLevel level) : level_(level), shows_progress_(level >= LogLevel::warning && isatty(STDERR_FILENO) == 1) {}

Terminal::~Terminal() {
  const std::lock_guard lock(mutex_);
  clear_line();
}

void Terminal::clear_line() {
  if (line_is_open_) std::fputs("\r\033[K", stderr);
  line_is_open_ = false;
}

void Terminal::report(std::string_view what, double fraction) {
  if (!shows_progress_) return;
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  std::fprintf(stderr, "\r\033[K%.*s %3.0f %%", static_cast<int>(what.size()), what.data(), 100 * fraction);
  std::fflush(stderr);
  line_is_open_ = true;
}

void Terminal::log(LogLevel level, const std::string& line) {
  if (level > level_) return;
  const std::lock_guard lock(mutex_);
  clear_line();
  std::fprintf(stderr, "%s\n", line.c_str());
}

void stop_on_signals(Terminal& terminal) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // threads to come inherit it
  std::thread([signals, &terminal] {
    int number = 0;
    sigwait(&signals, &number);
    terminal.stop();
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    remove_temporaries();
    _exit(130);
  }).detach();
}

}  // namespace airlight
