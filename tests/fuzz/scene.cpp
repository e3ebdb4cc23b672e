// Any text is a scene, in every frame, or is refused with InputError; nothing else may happen.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "common/error.h"
#include "common/scene/load.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  airlight::NoProgress progress;
  try {
    airlight::SceneFile file({reinterpret_cast<const char*>(data), size}, "fuzz.json", AIRLIGHT_FUZZ_FILES);
    const auto [first, last] = file.frames();
    for (const int frame : {first, first + (last - first) / 2, last}) file.scene(frame, progress);
  } catch (const airlight::InputError& e) {
    const std::string_view message = e.what();
    if (message.empty() || message.find('\n') != message.npos) std::abort();  // one line
  }
  return 0;
}
