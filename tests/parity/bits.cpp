// airlight-bits: a hash of every bit that the CPU backend makes of each parity case, to be compared between builds
// (tests/parity/bits). Needs no test library, no OpenGL and no image library, so that it can be built for another processor.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "common/plan/hash.h"
#include "cpu/backend.h"
#include "tests/parity/case.h"

using namespace airlight;

namespace {

int usage() {
  std::fputs(
      "usage: airlight-bits [scalar | avx2 | avx512 | neon | widest [THREADS [NAME]]]   widest on one thread; cases whose name "
      "begins so\n",
      stderr);
  return 2;
}

std::string_view argument_of(Simd simd) {
  switch (simd) {
    case Simd::scalar:
      return "scalar";
    case Simd::avx2:
      return "avx2";
    case Simd::avx512:
      return "avx512";
    case Simd::neon:
      break;
  }
  return "neon";
}

// What the cases are made of is told apart: inputs that differ explain results that differ.
void print_hashes(const NamedCase& named, Extent extent, const CpuOptions& options) {
  const Case c = named.make(extent);
  Hash inputs, results;
  for (const auto& buffer : c.buffers) inputs.bytes(buffer.second);
  for (const auto& image : c.images) inputs.bytes(std::as_bytes(std::span(image.second)));
  CpuBackend backend(options);
  upload(backend, c);
  NoProgress progress;
  Stats stats;
  backend.run(c.steps, stats, progress);
  for (const auto& result : c.results) {
    const std::vector<float> values = download(backend, result.second);
    results.bytes(std::as_bytes(std::span(values)));
  }
  std::printf("%.*s %016llx %016llx\n", static_cast<int>(named.name.size()), named.name.data(),
              static_cast<unsigned long long>(inputs.value()), static_cast<unsigned long long>(results.value()));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CpuOptions options{.threads = argc > 2 ? std::atoi(argv[2]) : 1};
  const std::string_view name = argc > 3 ? argv[3] : "";
  if (argc > 4 || options.threads < 1) return usage();
  if (argc > 1 && std::string_view(argv[1]) != "widest") {
    bool there = false;
    for (const Simd simd : available_simd()) {
      if (argument_of(simd) != argv[1]) continue;
      options.simd = simd;
      there = true;
    }
    if (!there) return usage();
  }
  std::fprintf(stderr, "%s\n", CpuBackend(options).describe().c_str());
  for (const NamedCase& named : all_cases()) {
    if (named.name.starts_with(name)) print_hashes(named, {72, 70}, options);  // four tiles, three of them cut off
  }
  for (const NamedCase& named : long_cases()) {
    if (named.name.starts_with(name)) print_hashes(named, {24, 18}, options);
  }
}
