// Any bytes are Gaussians or are refused with InputError. The first byte chooses the format.
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/error.h"
#include "common/scene/gaussians_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string path = (std::filesystem::temp_directory_path() /
                            ("airlight-fuzz-" + std::to_string(getpid()) + (data[0] % 2 == 0 ? ".ply" : ".csv")))
                               .string();
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
  airlight::NoProgress progress;
  try {
    for (const airlight::Gaussian& g : airlight::read_gaussians_file(path, progress).gaussians) {
      if (!(g.radius > 0 && g.extinction >= 0) || !std::isfinite(g.radius + g.extinction + g.center.x)) std::abort();
    }
  } catch (const airlight::InputError& e) {
    if (std::string(e.what()).find('\n') != std::string::npos) std::abort();  // one line
  }
  std::filesystem::remove(path);
  return 0;
}
