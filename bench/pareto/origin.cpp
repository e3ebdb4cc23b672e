#include "bench/pareto/origin.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>

#include "app/airlight.h"

namespace airlight {

namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string compiler() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
  return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
  return "unknown compiler";
#endif
}

}  // namespace

void add_machine(Origin& origin) {
  origin.version = version();
  origin.commit = AIRLIGHT_COMMIT;
  origin.compiler = compiler();
  origin.machine = fmt::format("{}, {} cores", processor(), std::thread::hardware_concurrency());
}

}  // namespace airlight
