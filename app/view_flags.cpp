// The flags of airlight view; of a build without the viewer, what it says instead.
#include <CLI/CLI.hpp>

#include "app/command.h"

namespace airlight {

namespace {

constexpr const char* examples = R"(Examples
  airlight view scenes/fog_bunny.json
  airlight view fog.json --backend gl -o painted.json --record painted.jsonl
  airlight view street.glb --visibility 80
Mouse: left uses the tool (drags a light's ring, whatever the tool), right turns, middle shifts, wheel goes nearer.
Keys: 1-6 tools, B backend CPU or GL, R reference, V split view, F frame, Home first view, W A S D Q E fly, Ctrl+Z undo,
      Ctrl+Y redo, Ctrl+C copy, Ctrl+V paste, Ctrl+S save, P picture, Shift+P window, Tab panel, Esc cancel.
What is recorded, `airlight edit SCENE RECORD -o OUTPUT` does again without a window.
)";

}  // namespace

CLI::App* add_view_command(CLI::App& program, ViewCommand& c, std::string& size) {
  CLI::App* command = program.add_subcommand("view", "look at a scene in a window, paint fog, compare backends");
  command->add_option("SCENE", c.scene, "scene file (JSON, glTF)")->required();
  command->add_option("-o,--output", c.output, "where Ctrl+S saves (default: SCENE_edited.json beside it)");
  command->add_option("--record", c.record, "write every edit to this script");
  command->add_option("--size", size, "WIDTHxHEIGHT of the picture")->capture_default_str();
  command->add_option("--exposure", c.exposure, "stops, at first")->check(CLI::Range(-8.0F, 8.0F))->capture_default_str();
  command->add_option("--backend", c.renderer.backend, "cpu | gl at first")->capture_default_str();
  command->add_option("--threads", c.renderer.threads, "threads of the CPU, 0: as many as there are")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  c.renderer.gl_context = "window";
  command
      ->add_option(
          "--gl-context", c.renderer.gl_context,
          "window | auto | osmesa | egl; window is OpenGL 4.5 of the window system, whose pictures are drawn directly; those of "
          "all others are read back")
      ->capture_default_str();
  command->footer(examples);
  return command;
}

#ifndef AIRLIGHT_VIEWER
int view(const ViewCommand&, Terminal&) {
  throw MachineError("view: this program was built without the viewer (-DAIRLIGHT_VIEWER=OFF)");
}
#endif

}  // namespace airlight
