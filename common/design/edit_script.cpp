#include "common/design/edit_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "common/error.h"

namespace airlight {

std::vector<ScriptLine> parse_edits(std::string_view text, const std::string& name) {
  std::vector<ScriptLine> lines;
  int number = 1;
  for (std::size_t at = 0; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == line.npos || line.substr(first, 2) == "//") continue;
    const json::Value value = json::parse(line, name, number);
    lines.push_back({parse_edit(Node(value, name, "")), value.place});
  }
  return lines;
}

void replay(const std::vector<ScriptLine>& lines, const std::string& name, SceneEditor& editor, Progress& progress) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    progress.report("edits", static_cast<double>(i) / static_cast<double>(lines.size()));
    progress.check();
    try {
      editor.apply(lines[i].edit);
    } catch (const InputError& e) {
      throw InputError(json::message(name, lines[i].place, e.what()));
    }
  }
}

}  // namespace airlight
