// Any bytes are a tabulated reflectance or are refused with InputError.
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/error.h"
#include "common/scene/brdf_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("airlight-fuzz-" + std::to_string(getpid()) + ".binary")).string();
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const airlight::BrdfFile file = airlight::read_brdf_file(path);
    for (const float v : file.brdf->values) {
      if (!(v >= 0) || !std::isfinite(v)) std::abort();
    }
    const airlight::Material& m = file.material;
    for (int c = 0; c < 3; ++c) {
      if (!(m.diffuse[c] >= 0 && m.specular[c] >= 0 && m.diffuse[c] + m.specular[c] <= 1.0001F)) std::abort();
    }
  } catch (const airlight::InputError& e) {
    if (std::string(e.what()).find('\n') != std::string::npos) std::abort();  // one line
  }
  std::filesystem::remove(path);
  return 0;
}
