#include "cpu/parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#ifdef AIRLIGHT_TBB
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/version.h>
#endif
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace airlight {

namespace {

// Flushes denormals to zero while it lives, then puts the thread's mode back.
class FlushToZero {
 public:
#if defined(__x86_64__)
  FlushToZero() : before_(_mm_getcsr()) { _mm_setcsr((before_ & ~0x6000U) | 0x8040U); }  // FTZ, DAZ, round to nearest
  ~FlushToZero() { _mm_setcsr(before_); }

 private:
  unsigned before_;
#elif defined(__aarch64__)
  FlushToZero() {
    asm volatile("mrs %0, fpcr" : "=r"(before_));
    const std::uint64_t mode = (before_ & ~(3ULL << 22U)) | (1ULL << 24U);  // FZ, round to nearest
    asm volatile("msr fpcr, %0" : : "r"(mode));
  }
  ~FlushToZero() { asm volatile("msr fpcr, %0" : : "r"(before_)); }

 private:
  std::uint64_t before_ = 0;
#endif

 public:
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;
};

}  // namespace

#ifdef AIRLIGHT_TBB

std::string parallel_library() { return "oneTBB " + std::to_string(TBB_VERSION_MAJOR) + "." + std::to_string(TBB_VERSION_MINOR); }

struct Workers::Pool {
  explicit Pool(int threads) : arena(threads) {
    // More threads than the machine has cores need leave. Not asked for otherwise: the least of all such controls in the process
    // holds.
    if (threads > tbb::this_task_arena::max_concurrency()) {
      more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    }
  }
  std::optional<tbb::global_control> more;
  tbb::task_arena arena;
};

void Workers::loop(int n, const std::function<void(int, int)>& body) {
  pool_->arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, n, 1),
        [&](const tbb::blocked_range<int>& range) {
          const int worker = tbb::this_task_arena::current_thread_index();
          const FlushToZero mode;
          ran_[static_cast<std::size_t>(worker)].id.store(std::this_thread::get_id(), std::memory_order_relaxed);
          for (int i = range.begin(); i != range.end(); ++i) body(i, worker);
        },
        tbb::simple_partitioner());
  });
}

#else

std::string parallel_library() { return "std::thread"; }

// Threads sleep between loops; in one they take the next index until none is left.
struct Workers::Pool {
  explicit Pool(int threads) {
    for (int worker = 1; worker < threads; ++worker) others.emplace_back([this, worker] { serve(worker); });
  }
  ~Pool() {
    {
      const std::lock_guard lock(mutex);
      stop = true;
    }
    wake.notify_all();
    for (std::thread& t : others) t.join();
  }

  void serve(int worker) {
    std::uint64_t seen = 0;
    for (;;) {
      {
        std::unique_lock lock(mutex);
        wake.wait(lock, [&] { return stop || round != seen; });
        if (stop) return;
        seen = round;
      }
      work(worker);
      const std::lock_guard lock(mutex);
      if (--busy == 0) done.notify_one();
    }
  }

  void work(int worker) {
    const FlushToZero mode;
    for (int i = next.fetch_add(1); i < end; i = next.fetch_add(1)) {
      try {
        (*body)(i, worker);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = end;
      }
    }
  }

  std::vector<std::thread> others;
  std::mutex mutex;
  std::condition_variable wake, done;
  std::uint64_t round = 0;
  int busy = 0;
  bool stop = false;
  std::atomic<int> next{0};
  int end = 0;
  const std::function<void(int, int)>* body = nullptr;
  std::exception_ptr failure;
};

void Workers::loop(int n, const std::function<void(int, int)>& body) {
  const std::function<void(int, int)> counted = [&](int i, int worker) {
    ran_[static_cast<std::size_t>(worker)].id.store(std::this_thread::get_id(), std::memory_order_relaxed);
    body(i, worker);
  };
  Pool& p = *pool_;
  {
    const std::lock_guard lock(p.mutex);
    p.body = &counted;
    p.next = 0;
    p.end = n;
    p.failure = nullptr;
    p.busy = static_cast<int>(p.others.size());
    ++p.round;
  }
  p.wake.notify_all();
  p.work(0);
  std::unique_lock lock(p.mutex);
  p.done.wait(lock, [&] { return p.busy == 0; });
  if (p.failure) std::rethrow_exception(p.failure);
}

#endif

Workers::Workers(int threads)
    : threads_(std::max(1, threads)), pool_(std::make_unique<Pool>(threads_)), ran_(static_cast<std::size_t>(threads_)) {}

Workers::~Workers() = default;

void Workers::each(int n, const std::function<void(int, int)>& body) {
  for (Ran& r : ran_) r.id.store(std::thread::id(), std::memory_order_relaxed);
  if (n > 0) loop(n, body);
}

int Workers::distinct_threads() const {
  const auto id = [](const Ran& r) { return r.id.load(std::memory_order_relaxed); };
  int count = 0;
  for (auto r = ran_.begin(); r != ran_.end(); ++r) {
    const bool again = std::any_of(ran_.begin(), r, [&](const Ran& other) { return id(other) == id(*r); });
    if (id(*r) != std::thread::id() && !again) ++count;
  }
  return count;
}

}  // namespace airlight
