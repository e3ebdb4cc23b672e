// Any bytes are a grid or are refused with InputError.
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/error.h"
#include "common/scene/grid_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("airlight-fuzz-" + std::to_string(getpid()) + ".vdb")).string();
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  airlight::NoProgress progress;
  try {
    const airlight::GridFile file = airlight::read_grid_file(path, "density", progress);
    for (const float v : file.voxels->values) {
      if (!(v >= 0) || !std::isfinite(v)) std::abort();
    }
  } catch (const airlight::InputError& e) {
    if (std::string(e.what()).find('\n') != std::string::npos) std::abort();  // one line
  }
  std::filesystem::remove(path);
  return 0;
}
