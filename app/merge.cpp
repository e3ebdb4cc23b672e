#include "common/scene/merge.h"

#include <fmt/format.h>

#include "app/command.h"

namespace airlight {

int merge(const MergeCommand& c, Terminal& terminal) {
  for (const std::string& name : merge_tiles(c.tiles, c.output, c.file, terminal))
    terminal.log(LogLevel::info, fmt::format("{}: of {} tiles", name, c.tiles.size()));
  return 0;
}

}  // namespace airlight
