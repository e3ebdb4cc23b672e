// Every parity case as a benchmark, at 400 x 300, on each backend and SIMD target: warm runs, inputs renamed so that nothing is
// reused. Cases of one algorithm stand side by side: the ratio of two rows of one run is the figure to quote.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <variant>

#include "cpu/backend.h"
#include "gpu/backend.h"
#include "tests/parity/case.h"

namespace airlight {

namespace {

constexpr Extent extent{400, 300};

// Makes the case's steps stale without copying anything large: one input under a new name, or, where they read none, their
// results.
void make_stale(Backend& backend, const Case& c, std::uint64_t key) {
  if (!c.images.empty()) return backend.upload(c.images[0].first, c.images[0].second, key);
  if (!c.buffers.empty()) return backend.upload(c.buffers[0].first, c.buffers[0].second, key);
  for (const auto& [name, result] : c.results) {
    if (const auto* image = std::get_if<Image>(&result)) {
      backend.upload(*image, std::vector<float>(image->floats()), key);
    } else {
      const Buffer& buffer = std::get<Buffer>(result);
      backend.upload(buffer, std::vector<std::byte>(buffer.bytes), key);
    }
  }
}

void run_case(benchmark::State& state, const NamedCase& named, Backend& backend) {
  const Case c = named.make(extent);
  upload(backend, c);
  NoProgress progress;
  Stats stats;
  static std::uint64_t key = 1000;  // the library calls this several times for one row: never the same name again
  std::uint64_t pixels = 0;
  for (auto _ : state) {
    state.PauseTiming();
    make_stale(backend, c, ++key);
    state.ResumeTiming();
    backend.run(c.steps, stats, progress);
    pixels += static_cast<std::uint64_t>(extent.width * extent.height);
  }
  if (std::all_of(stats.steps.begin(), stats.steps.end(), [](const StepStats& s) { return s.reused; }))
    state.SkipWithError("no step was run again");
  const bool image = std::holds_alternative<Image>(c.results.at(0).second);
  if (image) state.SetItemsProcessed(static_cast<std::int64_t>(pixels));
  for (const StepStats& step : stats.steps) state.counters[step.name + "_ms"] = step.seconds * 1e3;
}

}  // namespace

}  // namespace airlight

int main(int argc, char** argv) {
  using namespace airlight;
  const std::vector<NamedCase> cases = all_cases();
  std::vector<std::unique_ptr<Backend>> backends;
  std::vector<std::string> names;
  for (const Simd simd : available_simd()) {
    for (const int threads : {1, 2}) {
      backends.push_back(std::make_unique<CpuBackend>(CpuOptions{.simd = simd, .threads = threads, .fuse = true}));
      names.push_back("cpu/" + std::string(name_of(simd)) + "/" + std::to_string(threads));
    }
  }
  backends.push_back(std::make_unique<CpuBackend>(CpuOptions{.simd = available_simd().back(), .threads = 2, .fuse = false}));
  names.push_back("cpu/not_fused/2");
  try {
    backends.push_back(make_gl_backend({}));
    names.push_back("gl");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "no GL rows: %s\n", error.what());
  }
  for (const auto& backend : backends) std::printf("# %s\n", backend->describe().c_str());
  for (const NamedCase& c : cases) {
    for (std::size_t b = 0; b < backends.size(); ++b) {
      Backend* backend = backends[b].get();
      benchmark::RegisterBenchmark((std::string(c.name) + "/" + names[b]).c_str(),
                                   [c, backend](benchmark::State& state) { run_case(state, c, *backend); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
