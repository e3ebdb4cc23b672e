// The same bits for every SIMD target, number of threads, and with or without fusion; and proof that the comparison could fail.
#include <gtest/gtest.h>

#include <cfenv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <set>
#include <thread>

#include "common/error.h"
#include "common/scene/sha256.h"
#include "cpu/backend.h"
#include "cpu/parallel.h"
#include "gpu/backend.h"
#include "tests/parity/case.h"

namespace airlight {

namespace {

struct Run {
  std::string digest;
  int threads = 0;
};

Run run(const Case& c, const CpuOptions& options) {
  CpuBackend backend(options);
  upload(backend, c);
  Stats stats;
  NoProgress progress;
  backend.run(c.steps, stats, progress);
  EXPECT_EQ(backend.simd_that_ran(), options.simd) << "asked for " << name_of(options.simd);
  Sha256 digest;
  for (const auto& result : c.results) {
    const std::vector<float> values = download(backend, result.second);
    digest.add(std::as_bytes(std::span(values)));
  }
  return {digest.hex(), backend.threads_that_ran()};
}

class Bits : public testing::TestWithParam<NamedCase> {};

std::string gtest_name(const testing::TestParamInfo<NamedCase>& info) {
  std::string name(info.param.name);
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

TEST_P(Bits, SameOnEveryTargetAndThreadCount) {
  const Case c = GetParam().make({136, 80});  // six tiles, four of them cut off
  const std::string expected = run(c, {.simd = Simd::scalar, .threads = 1, .fuse = false}).digest;
  for (const Simd simd : available_simd()) {
    for (const int threads : {1, 2, 3, 8}) {
      if ((threads == 2 || threads == 3) && simd != available_simd().back()) continue;  // threads know nothing of lanes
      EXPECT_EQ(run(c, {.simd = simd, .threads = threads, .fuse = true}).digest, expected)
          << name_of(simd) << ", " << threads << " threads, fused";
    }
    EXPECT_EQ(run(c, {.simd = simd, .threads = 2, .fuse = false}).digest, expected) << name_of(simd) << ", not fused";
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, Bits, testing::ValuesIn(all_cases()), gtest_name);

class ForcedTarget : public testing::TestWithParam<Simd> {};

TEST_P(ForcedTarget, IsTheOneThatRuns) {
  const std::vector<Simd> there = available_simd();
  if (std::find(there.begin(), there.end(), GetParam()) == there.end()) {
    EXPECT_THROW(CpuBackend({.simd = GetParam()}), MachineError);
    GTEST_SKIP() << "skipped: no " << name_of(GetParam());
  }
  EXPECT_EQ(target_that_runs(GetParam()), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Targets, ForcedTarget, testing::Values(Simd::scalar, Simd::avx2, Simd::avx512, Simd::neon),
                         [](const auto& p) {
                           return std::string(name_of(p.param)) == "AVX-512" ? "AVX512" : std::string(name_of(p.param));
                         });

// Every item waits until all threads have one, so that no thread can do the work of two.
TEST(Threads, AsManyRunAsWereAskedFor) {
  for (const int threads : {1, 2, 3, 8}) {
    Workers workers(threads);
    std::mutex mutex;
    std::set<std::thread::id> seen;
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    workers.each(threads, [&](int, int) {
      for (;;) {
        {
          const std::lock_guard lock(mutex);
          seen.insert(std::this_thread::get_id());
          if (seen.size() == static_cast<std::size_t>(threads)) return;
        }
        if (std::chrono::steady_clock::now() > limit) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
    std::printf("%d threads asked, %zu ran\n", threads, seen.size());
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(threads));
    EXPECT_EQ(workers.distinct_threads(), threads);
  }
}

// In a frame a worker may find no work left before it wakes; some frame uses more than one.
TEST(Threads, ShareAFrame) {
  const Case c = frame_cases()[0].make({800, 600});
  const std::string expected = run(c, {.simd = available_simd().back(), .threads = 1, .fuse = true}).digest;
  for (const int threads : {2, 3, 8}) {
    int most = 0;
    for (int attempt = 0; attempt < 50 && most < threads; ++attempt) {
      const airlight::Run r = run(c, {.simd = available_simd().back(), .threads = threads, .fuse = true});
      EXPECT_EQ(r.digest, expected);
      most = std::max(most, r.threads);
    }
    std::printf("%d threads asked, %d had a tile of one frame\n", threads, most);
    EXPECT_GE(most, 2);
  }
}

TEST(Digest, SeesOneFlippedBit) {
  std::vector<float> values(1000, 0.5F);
  Sha256 before, after;
  before.add(std::as_bytes(std::span(values)));
  std::uint32_t word = 0;
  std::memcpy(&word, &values[500], sizeof word);
  word ^= 1U;
  std::memcpy(&values[500], &word, sizeof word);
  after.add(std::as_bytes(std::span(values)));
  EXPECT_NE(before.hex(), after.hex());
}

TEST(Reuse, ASecondRunDoesNothingUntilAnInputChanges) {
  const Case c = frame_cases()[0].make({100, 80});
  CpuBackend backend({});
  upload(backend, c);
  Stats stats;
  NoProgress progress;
  backend.run(c.steps, stats, progress);
  const std::vector<float> first = download(backend, c.results[0].second);
  backend.run(c.steps, stats, progress);
  for (const StepStats& step : stats.steps) EXPECT_TRUE(step.reused) << step.name;
  EXPECT_EQ(download(backend, c.results[0].second), first);

  backend.upload(c.buffers[0].first, c.buffers[0].second, 12345);  // another name for the positions
  backend.run(c.steps, stats, progress);
  for (const StepStats& step : stats.steps) EXPECT_FALSE(step.reused) << step.name;
  EXPECT_EQ(download(backend, c.results[0].second), first);
}

// Each case has its own meaning for each handle. On OpenGL one case of each algorithm: a new backend compiles all of its shaders.
TEST(Reuse, OnePlanAfterAnotherIsAsOnANewBackend) {
  Stats stats;
  NoProgress progress;
  const auto results = [&](Backend& backend, const NamedCase& named) {
    const Case c = named.make({100, 75});
    upload(backend, c);
    backend.run(c.steps, stats, progress);
    std::vector<std::vector<float>> values;
    for (const auto& result : c.results) values.push_back(download(backend, result.second));
    return values;
  };
  CpuBackend cpu({});
  const std::unique_ptr<Backend> gl = make_gl_backend({.context = "osmesa"});
  std::set<std::string_view> on_gl;
  for (const NamedCase& named : all_cases()) {
    if (named.name.find("1M") != named.name.npos) continue;
    CpuBackend new_cpu({});
    EXPECT_EQ(results(cpu, named), results(new_cpu, named)) << named.name;
    if (!on_gl.insert(named.name.substr(0, named.name.find('/'))).second) continue;
    EXPECT_EQ(results(*gl, named), results(*make_gl_backend({.context = "osmesa"}), named)) << named.name;
  }
  EXPECT_GT(on_gl.size(), 20U);
}

TEST(Caller, KeepsItsFloatingPointMode) {
  const Case c = compose_cases()[0].make({64, 64});
  std::fenv_t before;
  std::fegetenv(&before);
  std::fesetround(FE_UPWARD);
  run(c, {.simd = available_simd().back(), .threads = 2, .fuse = true});
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
  volatile float smallest = 1e-40F;
  EXPECT_NE(smallest * 0.5F, 0.0F) << "denormals are still flushed";
  std::fesetenv(&before);
}

TEST(Stop, LeavesTheBackendUsable) {
  struct Stopped final : Progress {
    void report(std::string_view, double) override {}
    bool stop_requested() const override { return true; }
  } stopped;
  const Case c = frame_cases()[0].make({200, 150});
  CpuBackend backend({});
  upload(backend, c);
  Stats stats;
  EXPECT_THROW(backend.run(c.steps, stats, stopped), Interrupted);
  EXPECT_THROW(download(backend, c.results[0].second), std::logic_error);
  NoProgress progress;
  backend.run(c.steps, stats, progress);
  EXPECT_NO_THROW(download(backend, c.results[0].second));
}

}  // namespace

}  // namespace airlight
