#include <OpenImageIO/imageio.h>
#include <assimp/version.h>
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <CLI/Version.hpp>

#include <thread>

#include "app/command.h"
#include "common/scene/vdb_values.h"
#include "common/techniques/technique.h"
#include "cpu/parallel.h"
#include "cpu/targets.h"

namespace airlight {

namespace {

std::string dotted(int v) { return fmt::format("{}.{}.{}", v / 10000, v / 100 % 100, v % 100); }

void print_context(const std::string& context) {
  try {
    fmt::print("  {:<8} {}\n", context, Renderer({.backend = "gl", .gl_context = context}).describe());
  } catch (const MachineError& e) {
    fmt::print("  {:<8} not here: {}\n", context, e.what());
  }
}

}  // namespace

int info() {
  fmt::print("airlight {}\n", version());
  fmt::print("backend cpu, {} threads, SIMD targets:", std::thread::hardware_concurrency());
  for (const Simd simd : available_simd()) fmt::print(" {}", name_of(simd));
  fmt::print("\nbackend gl, contexts:\n");
  for (const char* context : {"osmesa", "egl"}) print_context(context);
  fmt::print("techniques:\n");
  for (const Technique& t : techniques()) fmt::print("  {}: {}\n", t.name, t.summary);
  fmt::print("libraries: OpenImageIO {}, assimp {}.{}.{}, {}, Embree {}, Highway {}, {}, fmt {}, CLI11 {}\n",
             dotted(OIIO::openimageio_version()), aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch(), grid_library(),
             RTC_VERSION_STRING, highway_version(), parallel_library(), dotted(FMT_VERSION), CLI11_VERSION);
  return 0;
}

}  // namespace airlight
