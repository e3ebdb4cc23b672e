// The kernels of every parity case once each, for a tool that counts instructions: bench/instructions runs this under callgrind.
//   airlight-instructions           runs all cases, names each on standard output before it runs
//   airlight-instructions CASE...   runs these
//   airlight-instructions --list    names all and runs none
#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>

#include "cpu/backend.h"
#include "tests/parity/case.h"
#ifdef AIRLIGHT_CALLGRIND
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#define CALLGRIND_DUMP_STATS
#endif

namespace airlight {

namespace {

constexpr Extent extent{128, 64};  // two tiles

// AVX2 where there is: what every tool of its kind can follow.
Simd counted_simd() {
  const std::vector<Simd> there = available_simd();
  return std::find(there.begin(), there.end(), Simd::avx2) != there.end() ? Simd::avx2 : Simd::scalar;
}

// Counted from its first step to its last, then written out; everything else runs uncounted, and so four times as fast.
void counted_run(Backend& backend, const Case& c) {
  Stats stats;
  NoProgress progress;
  CALLGRIND_START_INSTRUMENTATION;
  backend.run(c.steps, stats, progress);
  CALLGRIND_STOP_INSTRUMENTATION;
  CALLGRIND_DUMP_STATS;
}

}  // namespace

}  // namespace airlight

int main(int argc, char** argv) {
  using namespace airlight;
  const std::vector<NamedCase> all = all_cases();
  if (argc == 2 && std::string_view(argv[1]) == "--list") {
    for (const NamedCase& c : all) std::printf("%s\n", std::string(c.name).c_str());
    return 0;
  }
  for (int i = 1; i < argc; ++i) {
    if (std::none_of(all.begin(), all.end(), [&](const NamedCase& c) { return c.name == argv[i]; })) {
      std::fprintf(stderr, "unknown case \"%s\", expected one of those that airlight-instructions prints\n", argv[i]);
      return 2;
    }
  }
  const Simd simd = counted_simd();
#ifdef __clang__
  constexpr const char* compiler = "clang";
#else
  constexpr const char* compiler = "g++";
#endif
  std::printf("# %s, %s %s, %d x %d pixels, 1 thread\n", std::string(name_of(simd)).c_str(), compiler, __VERSION__, extent.width,
              extent.height);
  for (const NamedCase& named : all) {
    if (argc > 1 && std::none_of(argv + 1, argv + argc, [&](const char* a) { return named.name == a; })) continue;
    std::printf("%s\n", std::string(named.name).c_str());
    std::fflush(stdout);
    // A backend of its own for each case: no count depends on the cases before it.
    CpuBackend backend({.simd = simd, .threads = 1, .fuse = true});
    const Case c = named.make(extent);
    upload(backend, c);
    counted_run(backend, c);
  }
  return 0;
}
