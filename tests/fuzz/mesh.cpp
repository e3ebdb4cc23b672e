// Any bytes are a mesh or are refused with InputError. The first byte chooses the format.
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/error.h"
#include "common/scene/load.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr std::array<const char*, 4> formats{"obj", "ply", "glb", "stl"};
  const std::string path = (std::filesystem::temp_directory_path() /
                            ("airlight-fuzz-" + std::to_string(getpid()) + "." + formats[data[0] % formats.size()]))
                               .string();
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
  airlight::NoProgress progress;
  try {
    airlight::load_mesh(path, false, progress);
  } catch (const airlight::InputError& e) {
    if (std::string(e.what()).find('\n') != std::string::npos) std::abort();  // one line
  }
  std::filesystem::remove(path);
  return 0;
}
