#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/sequence.h"
#include "common/design/edit_script.h"
#include "common/design/scene_document.h"
#include "common/scene/files.h"
#include "common/scene/frame_pattern.h"

namespace airlight {

namespace {

constexpr std::uint64_t most_script_bytes = std::uint64_t{64} << 20U;

constexpr const char* examples = R"(Examples
  airlight edit city.json fog.jsonl -o foggy.json
  airlight edit pipe.json smoke.jsonl -o smoke.####.json --frames 0-47 --fps 24   # what an emitter has sent out by then
A script has one edit a line; airlight view --record writes such files.
  {"edit": "paint", "screen": [[-0.8, 0], [0.8, 0.1]], "plane": {"point": [0, 1, 0], "normal": [0, 1, 0]}, "radius": 0.5}
  {"edit": "erase", "screen": [[0, 0.05]], "radius": 0.3, "amount": 0.5}
  {"edit": "undo"}
)";

}  // namespace

CLI::App* add_edit_command(CLI::App& program, EditCommand& c) {
  CLI::App* command = program.add_subcommand("edit", "change a scene by a script of edits");
  command->add_option("SCENE", c.scene, "scene file (JSON)")->required();
  command->add_option("SCRIPT", c.script, "edits, one JSON object a line")->required();
  command->add_option("-o,--output", c.output, "scene file to write; #### in its name is the number of a frame")->required();
  command->add_option("--frames", c.frames, "12, 0-47 or 0-47x4: a scene each, in which emitters have gone on");
  command->add_option("--fps", c.fps, "frames a second")->check(CLI::Range(1e-3, 1e6))->capture_default_str();
  command->footer(examples);
  return command;
}

int edit(const EditCommand& c, Terminal& terminal) {
  const std::vector<int> frames = c.frames.empty() ? std::vector<int>{0} : frame_numbers(c.frames, {});
  if (frames.size() > 1 && !has_frame_pattern(c.output)) {
    throw InputError(fmt::format("{}: no place for the number of the frame, expected a name such as scene.####.json", c.output));
  }
  const SceneDocument document(c.scene);
  const std::vector<ScriptLine> lines = parse_edits(read_file(c.script, most_script_bytes), c.script);
  for (const int frame : frames) {
    SceneEditor editor(document.scene(), frame / c.fps);
    replay(lines, c.script, editor, terminal);
    const std::string name = c.frames.empty() ? c.output : with_frame(c.output, frame);
    document.save(editor.scene(), name);
    terminal.log(LogLevel::info,
                 fmt::format("{}: {} edits, {} Gaussians", name, lines.size(), editor.scene().medium.gaussians.size()));
  }
  return 0;
}

}  // namespace airlight
