#include <filesystem>

#include "app/command.h"
#include "common/scene/convert_scene.h"
#include "common/scene/files.h"
#include "common/scene/temporary_file.h"

namespace airlight {

int convert(const ConvertCommand& c, Terminal& terminal) {
  if (std::filesystem::path(c.output).extension() != ".json")
    throw InputError(c.output + ": expected a name that ends with .json");
  const ConvertedScene made = convert_scene(c.input, folder_of(c.output), c.fog, terminal);
  TemporaryFile file(c.output);
  file.write(made.json.data(), made.json.size());
  file.rename_to_target();
  for (const std::string& note : made.notes) terminal.log(LogLevel::warning, note);
  return 0;
}

}  // namespace airlight
