// Parallel loops: the only place that knows a threading library. oneTBB, or plain std::thread where AIRLIGHT_TBB is not
// defined (thread sanitizer, machines without oneTBB).
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace airlight {

// "oneTBB 2021.8" or "std::thread"
std::string parallel_library();

// A pool of `threads` workers (at least 1; the calling thread is one of them). Each worker flushes denormals to zero while it
// runs a loop; the caller's floating-point mode is restored afterwards.
class Workers {
 public:
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return threads_; }

  // body(i, worker) for i in 0..n-1, in any order and on any worker; worker in 0..threads-1 names the thread's own scratch. The
  // first exception is rethrown here when all have stopped.
  void each(int n, const std::function<void(int i, int worker)>& body);

  // How many different threads have run something in the last each().
  int distinct_threads() const;

 private:
  struct Pool;
  struct alignas(64) Ran {
    std::atomic<std::thread::id> id;  // of the thread that worked under this number in the last each()
  };
  void loop(int n, const std::function<void(int i, int worker)>& body);

  int threads_;
  std::unique_ptr<Pool> pool_;
  std::vector<Ran> ran_;
};

}  // namespace airlight
