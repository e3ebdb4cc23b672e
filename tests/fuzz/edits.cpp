// Any text is a script of edits, or is refused with InputError in one line; what is read is written and read again without loss.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "common/design/edit_script.h"
#include "common/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string written;
  try {
    for (const auto& line : airlight::parse_edits({reinterpret_cast<const char*>(data), size}, "fuzz.jsonl"))
      written += airlight::line_of(line.edit);
  } catch (const airlight::InputError& e) {
    const std::string_view message = e.what();
    if (message.empty() || message.find('\n') != message.npos) std::abort();
  }
  std::string again;  // of lines that were accepted: may not throw
  for (const auto& line : airlight::parse_edits(written, "again.jsonl")) again += airlight::line_of(line.edit);
  if (again != written) std::abort();
  return 0;
}
