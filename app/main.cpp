// The program `airlight`: command line, messages, exit codes (0 done, 1 images differ, 2 bad input, 3 the machine cannot, 130
// stopped).
#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <iostream>
#include <optional>

#include "app/command.h"
#include "app/tile.h"
#include "common/fit/fit_gaussians.h"
#include "common/scene/import_process.h"
#include "common/scene/limits.h"
#include "common/spelling.h"
#include "common/techniques/technique.h"

namespace airlight {

namespace {

// "800x600" into an extent.
Extent extent_of(const char* flag, const std::string& text) {
  Extent e;
  int used = 0;
  if (std::sscanf(text.c_str(), "%6dx%6d%n", &e.width, &e.height, &used) != 2 || static_cast<std::size_t>(used) != text.size()) {
    throw InputError(std::string(flag) + ": expected WIDTHxHEIGHT, found \"" + text + "\"");
  }
  return e;
}

std::pair<std::string, std::string> setting_of(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0) throw InputError("--set: expected NAME=VALUE, found \"" + text + "\"");
  return {text.substr(0, at), text.substr(at + 1)};
}

std::string knobs_text() {
  std::string all = "Settings (--set NAME=VALUE)\n";
  for (const Technique& t : techniques()) {
    all += "  " + std::string(t.name) + "\n";
    for (const Knob& k : t.knobs) {
      all += "    " + std::string(k.name) + " = " + std::string(k.standard) + "   " + std::string(k.meaning);
      all += k.kind == Knob::Kind::choice ? " (" + joined(k.choices, " | ") + ")" : "";
      all += "\n";
    }
  }
  return all;
}

constexpr const char* program_examples = R"(Examples
  airlight render fog.json -o fog.exr
  airlight render fog.json -o fog.png --backend gl --exposure 1
  airlight render fog.json -o truth.exr --technique reference --resolution 96x72
  airlight render smoke.json -o all.exr --technique reference --set max_bounces=1000000 --set paths=4096 --aov standard_error
  airlight compare fog.exr truth.exr --tolerance 0.001
  airlight explain fog.json
  airlight plan lamp.json --frames 0-47 --tiles 4 -o lamp.####.exr
  airlight merge fog.tile-1-of-2.exr fog.tile-2-of-2.exr -o fog.exr
  airlight edit fog.json strokes.jsonl -o painted.json
  airlight view fog.json
  airlight info smoke.vdb
  airlight fit smoke.vdb -n 2000 -o smoke.ply
Meshes are read in a process of its own, which may take 10 s of CPU time and 4 GiB of memory, and for each MiB of the file
0.5 s and 16 MiB more; what takes more, or ends it, is refused.
)";
constexpr const char* render_examples = R"(Examples
  airlight render street.glb -o street.png --visibility 80 --exposure 8
  airlight render fog.json -o fog.exr --aov depth,airlight --stats
  airlight render fog.json -o fog.png --supersample 3 --tonemap reinhard
  airlight render smoke.json -o smoke.exr --error 1%
  airlight render fog.json -o fog.exr --simd scalar --threads 1 --set table_nodes=128
  airlight render lamp.json --frames 0-47 -o lamp.####.exr --resume
  airlight render fog.json --tile 2/8 -o fog.tile-2-of-8.exr
  airlight render fog.json --resolution 16384x16384 -o large.exr --memory 2G
EXR files hold every image asked for, in channels NAME.R ...; other formats get one file an image.
)";

constexpr const char* plan_examples = R"(Examples
  airlight plan lamp.json --frames 0-47 --tiles 4 -o lamp.####.png >tiles
  airlight plan lamp.json --frames 0-47 --tiles 4 -o lamp.####.png --merge >merges
  parallel <tiles && parallel <merges
Each line is a command by itself, in any order, on any machine that sees the files; a line that is run again keeps what is
there. docs/farm.md shows GNU parallel and Slurm.
)";
constexpr const char* merge_examples = R"(Examples
  airlight merge fog.tile-*-of-8.exr -o fog.exr
  airlight merge fog.tile-*-of-8.exr -o fog.png --exposure 1
The file has the bytes that rendering at once gives. Tiles of another scene, version or setting, gaps, overlaps and damaged files
are refused.
)";

// What the command line gives as text.
struct Flags {
  RenderCommand render;
  PlanCommand plan;
  MergeCommand merge;
  std::optional<std::string> tile, memory;
  CompareCommand compare;
  EditCommand edit;
  ViewCommand view;
  FitCommand fit;
  ConvertCommand convert;
  std::string view_size = "800x600", resolution, log_level = "warning", info_file;
  std::vector<std::string> settings;
  std::optional<std::string> error, budget;
  bool quiet = false;
};

void add_fog_flags(CLI::App& command, std::optional<double>& fog) {
  CLI::Option* extinction = command.add_option("--fog", fog, "extinction of homogeneous fog [1/m], in place of the scene's")
                                ->check(CLI::Range(limits::extinction.least, limits::extinction.most));
  command
      .add_option_function<double>(
          "--visibility", [&fog](double metres) { fog = limits::koschmieder / metres; },
          "the same as the distance [m] at which 2 % of contrast are left")
      ->check(CLI::Range(limits::koschmieder / limits::extinction.most, 1e9))
      ->excludes(extinction);
}

void add_scene_flags(CLI::App& command, Flags& f) {
  std::vector<std::string> names{"auto"};
  for (const Technique& t : techniques()) names.emplace_back(t.name);
  std::string list;
  for (const std::string& n : names) list += (list.empty() ? "" : " | ") + n;
  command.add_option("SCENE", f.render.scene, "scene file (JSON, glTF)")->required();
  add_fog_flags(command, f.render.fog);
  command.add_option("--technique", f.render.settings.technique, list)->capture_default_str();
  command.add_option("--set", f.settings, "NAME=VALUE, a setting of the technique; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command
      .add_option("--aov", f.render.aovs,
                  "more images, separated by commas: surface, surface.direct, surface.indirect, surface.ambient, transmittance, "
                  "airlight, airlight.LIGHT, depth, normal, optical_depth; of the reference standard_error")
      ->delimiter(',');
  command.add_option("--error", f.error, "choose technique and settings for at most this relative RMSE: 1% or 0.01");
  command.add_option("--budget", f.budget, "choose the most exact technique and settings for this time a frame: 30ms or 0.03s");
  command.add_option("--resolution", f.resolution, "WIDTHxHEIGHT instead of the camera's");
  command.add_option("--supersample", f.render.settings.supersample, "n x n samples a pixel, 1 to 16")->capture_default_str();
}

void add_tonemap_flags(CLI::App& command, ImageFileOptions& file) {
  command.add_option("--exposure", file.exposure, "stops, for tone-mapped files")
      ->check(CLI::Range(-100.0, 100.0))
      ->capture_default_str();
  command.add_option("--tonemap", file.tonemap, "clip | reinhard, for tone-mapped files")->capture_default_str();
}

CLI::Option* add_output_flag(CLI::App& command, std::string& output) {
  return command
      .add_option("-o,--output", output, "image file: exr, pfm, tif, hdr (linear), png, jpg, bmp, tga, ppm (tone-mapped)")
      ->required();
}

// What runs where: the same on each line of a plan.
void add_device_flags(CLI::App& command, Flags& f) {
  RenderCommand& r = f.render;
  command.add_option("--backend", r.renderer.backend, "cpu | gl")->capture_default_str();
  command.add_option("--threads", r.renderer.threads, "threads of the CPU, 0: as many as there are")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command.add_option("--simd", r.renderer.simd, "auto | scalar | avx2 | avx512 | neon")->capture_default_str();
  command
      .add_option("--gl-context", r.renderer.gl_context, "auto | osmesa | egl; auto is EGL where there is hardware, else OSMesa")
      ->capture_default_str();
  command.add_option("--gl-device", r.renderer.gl_device, "which EGL device")->check(CLI::Range(0, 1024))->capture_default_str();
  command.add_option(
      "--memory", f.memory,
      "512M, 4G: for images, volumes, meshes and tables; a larger image is rendered and written band by band, the same bytes. "
      "Unless said 4G, and more where 64 rows take more");
  r.renderer.transfer_files = true;
  command
      .add_flag(
          "--transfer-files,!--no-transfer-files", r.renderer.transfer_files,
          "keep what surfaces hide of an environment in files of $XDG_CACHE_HOME/airlight (~/.cache/airlight), and read them")
      ->default_str("true");
}

void add_frames_flag(CLI::App& command, RenderCommand& r) {
  command.add_option("--frames", r.frames,
                     "of an animation: 12, 0-47, 0-47x4 (every fourth) or all; #### in names of outputs is the frame's number");
}

void add_render_flags(CLI::App& command, Flags& f) {
  RenderCommand& r = f.render;
  add_output_flag(command, r.output);
  add_frames_flag(command, r);
  command.add_option("--tile", f.tile, "2/8: the second of eight bands of rows alone, as an EXR file for airlight merge");
  command.add_flag("--resume", r.resume, "keep the frames that are there, whole and of this scene and these settings");
  add_tonemap_flags(command, r.file);
  add_device_flags(command, f);
  command.add_flag("--stats", r.stats, "print what each step took");
  command.add_option("--stats-json", r.stats_file, "write the same to a file");
  command.add_flag("--explain", r.explain, "print what runs, before it runs");
  command.add_flag("--quiet", f.quiet, "print errors only");
  command.add_option("--log-level", f.log_level, "error | warning | info | debug")
      ->check(CLI::IsMember({"error", "warning", "info", "debug"}))
      ->capture_default_str();
}

constexpr const char* fit_examples = R"(Examples
  airlight fit smoke.vdb -n 2000 -o smoke.ply
  airlight fit clouds.vdb --name clouds -n 500 --steps 400 -o clouds.ply
A scene takes the file in place of the grid, with the same placement and scale:
  "gaussians_file": { "file": "smoke.ply", "scale": 6, "rotate": [-90, 0, 0] }
)";

CLI::App* add_fit(CLI::App& program, FitCommand& f) {
  CLI::App* command = program.add_subcommand("fit", "turn the density of a grid into a sum of Gaussians");
  command->add_option("INPUT", f.input, "OpenVDB (.vdb) or NRRD (.nrrd) file")->required();
  command->add_option("-o,--output", f.output, "PLY file of Gaussians, for gaussians_file in a scene")->required();
  command->add_option("-n,--count", f.count, "how many Gaussians")->check(CLI::Range(1, most_fitted))->capture_default_str();
  command->add_option("--name", f.name, "which grid of an OpenVDB file")->capture_default_str();
  command->add_option("--steps", f.steps, "of each descent, at most: more take longer and leave less")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--threads", f.threads, "threads of the CPU, 0: as many as there are; the result is the same")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command->add_flag("--quiet", f.quiet, "print errors only");
  command->footer(fit_examples);
  return command;
}

constexpr const char* convert_examples = R"(Examples
  airlight convert street.glb -o street.json
  airlight convert street.glb -o street.json --visibility 80
  airlight convert bunny.obj -o bunny.json --fog 0.5
)";

CLI::App* add_convert(CLI::App& program, ConvertCommand& c) {
  CLI::App* command = program.add_subcommand("convert", "write a glTF file or a mesh as a scene file");
  command->add_option("INPUT", c.input, "glTF file with a camera, or a mesh, which gets a camera and a sun")->required();
  command->add_option("-o,--output", c.output, "scene file (.json); it names the input's meshes")->required();
  add_fog_flags(*command, c.fog);
  command->footer(convert_examples);
  return command;
}

LogLevel level_of(const Flags& f) {
  if (f.quiet || f.log_level == "error") return LogLevel::error;
  if (f.log_level == "info") return LogLevel::info;
  return f.log_level == "debug" ? LogLevel::debug : LogLevel::warning;
}

// "4G" in bytes.
std::uint64_t memory_of(const std::string& text) {
  unsigned amount = 0;
  char unit = 0;
  int used = 0;
  const std::size_t power = std::sscanf(text.c_str(), "%6u%c%n", &amount, &unit, &used) == 2 ? std::string_view("KMG").find(unit)
                                                                                             : std::string_view::npos;
  if (power == std::string_view::npos || static_cast<std::size_t>(used) != text.size() || amount == 0)
    throw InputError("--memory: expected a number and K, M or G, as 4G, found \"" + text + "\"");
  return std::uint64_t{amount} << (10 * (power + 1));
}

// The options that were given, as words of a shell, but for those that differ from line to line.
std::string given(const CLI::App& command, bool of_whole_pictures) {
  std::string words;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    const bool tone = name == "--exposure" || name == "--tonemap";
    constexpr std::array<std::string_view, 5> own{"SCENE", "--output", "--frames", "--tiles", "--merge"};
    if (option->count() == 0 || tone != of_whole_pictures || std::find(own.begin(), own.end(), name) != own.end()) continue;
    for (const std::string& value : option->results()) {
      const bool flag = option->get_expected_max() == 0;
      words += " " + name + (flag ? "=" + value : " " + shell_word(value));
    }
  }
  return words;
}

int run(int argc, char** argv) {
  Flags f;
  CLI::App program("airlight renders fog, and lamps and surfaces in it.", "airlight");
  program.set_version_flag("--version", "airlight " + std::string(version()));
  program.require_subcommand(1);
  program.footer(program_examples);
  CLI::App* render_command = program.add_subcommand("render", "render a scene to an image file");
  add_scene_flags(*render_command, f);
  add_render_flags(*render_command, f);
  render_command->footer(knobs_text() + render_examples);
  CLI::App* explain_command = program.add_subcommand("explain", "print what would run, what is left out and why");
  add_scene_flags(*explain_command, f);
  explain_command->footer(knobs_text());
  CLI::App* compare_command =
      program.add_subcommand("compare", "compare image A with image B, the truth; exit code 1 beyond the tolerance");
  compare_command->add_option("A", f.compare.a, "image file")->required();
  compare_command->add_option("B", f.compare.b, "image file")->required();
  compare_command->add_option("--image", f.compare.image,
                              "which of the files' images, for example depth (default: the main one)");
  compare_command->add_option("--tolerance", f.compare.tolerance, "largest relative RMSE")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  CLI::App* plan_command = program.add_subcommand(
      "plan", "print the commands that render frames by tiles, or merge these, one a line, for many machines");
  add_scene_flags(*plan_command, f);
  add_output_flag(*plan_command, f.render.output);
  add_frames_flag(*plan_command, f.render);
  plan_command->add_option("--tiles", f.plan.tiles, "bands of rows a frame")->check(CLI::Range(1, 65535))->capture_default_str();
  plan_command->add_flag("--merge", f.plan.merge, "print the commands that put the tiles together, for when all are there");
  add_tonemap_flags(*plan_command, f.render.file);
  add_device_flags(*plan_command, f);
  plan_command->footer(plan_examples);
  CLI::App* merge_command = program.add_subcommand("merge", "put tiles together to the picture that they are of");
  merge_command->add_option("TILES", f.merge.tiles, "files of airlight render --tile")->required();
  add_output_flag(*merge_command, f.merge.output);
  add_tonemap_flags(*merge_command, f.merge.file);
  merge_command->footer(merge_examples);
  CLI::App* edit_command = add_edit_command(program, f.edit);
  CLI::App* view_command = add_view_command(program, f.view, f.view_size);
  add_fog_flags(*view_command, f.view.fog);
  CLI::App* fit_command = add_fit(program, f.fit);
  CLI::App* convert_command = add_convert(program, f.convert);
  CLI::App* info_command = program.add_subcommand("info", "print backends, SIMD targets, GL contexts and libraries");
  info_command->add_option("FILE", f.info_file,
                           "print what is in a file instead: a scene (how many frames it has), a grid, Gaussians, a mesh");

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return program.exit(e);  // --help, --version
    throw InputError("airlight: " + std::string(e.what()) + " (airlight --help)");
  }

  ImportProcess reads_meshes;  // before there is another thread
  static Terminal terminal(*view_command ? LogLevel::info
                           : f.fit.quiet ? LogLevel::error
                                         : level_of(f));  // outlives the thread that waits for signals
  stop_on_signals(terminal);
  for (const std::string& s : f.settings) f.render.settings.knobs.push_back(setting_of(s));
  f.render.settings.goal = goal_of(f.error, f.budget);
  f.render.quiet = f.quiet;
  if (f.tile) f.render.tile = tile_of(*f.tile);
  if (f.memory) f.render.memory = memory_of(*f.memory);
  if (!f.resolution.empty()) f.render.settings.resolution = extent_of("--resolution", f.resolution);
  if (*render_command) return render(f.render, terminal);
  if (*explain_command) return explain(f.render, terminal);
  if (*plan_command) {
    f.plan.render = f.render;
    f.plan.program = argv[0];
    f.plan.options = given(*plan_command, false);
    f.plan.merge_options = given(*plan_command, true);
    return print_plan(f.plan);
  }
  if (*merge_command) return merge(f.merge, terminal);
  if (*compare_command) return compare(f.compare);
  if (*edit_command) return edit(f.edit, terminal);
  if (*view_command) {
    f.view.size = extent_of("--size", f.view_size);
    return view(f.view, terminal);
  }
  if (*fit_command) return fit(f.fit, terminal);
  if (*convert_command) return convert(f.convert, terminal);
  if (*info_command) return f.info_file.empty() ? info() : info_of_file(f.info_file, terminal);
  return 2;
}

}  // namespace

}  // namespace airlight

int main(int argc, char** argv) {
  const auto fail = [](const std::exception& e, int code) {
    std::cerr << e.what() << '\n';
    return code;
  };
  try {
    const int code = airlight::run(argc, argv);
    std::cout.flush();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw airlight::MachineError("standard output cannot be written");
    return code;
  } catch (const airlight::InputError& e) {
    return fail(e, 2);
  } catch (const airlight::Interrupted& e) {
    return fail(e, 130);
  } catch (const airlight::MachineError& e) {
    return fail(e, 3);
  } catch (const std::bad_alloc&) {
    return fail(airlight::MachineError("not enough memory"), 3);
  } catch (const std::exception& e) {
    std::cerr << "internal error: " << e.what() << '\n';
    return 3;
  }
}
