// The commands of the program `airlight`, each in its own file. Each returns its exit code and throws what the library throws.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/airlight.h"
#include "app/terminal.h"

namespace CLI {
class App;
}

namespace airlight {

// A part of a frame: a band of its rows (common/plan/rows.h).
struct TileNumber {
  int number = 1, count = 1;  // 1 <= number <= count
};

struct RenderCommand {
  std::string scene;
  std::optional<double> fog;  // [1/m] extinction in place of the scene's
  std::string output;
  RendererOptions renderer;
  RenderSettings settings;
  std::vector<std::string> aovs;
  std::string frames;  // "12", "0-47", "0-47x4" (every fourth), "all"; empty: the first, and names are taken as they are
  std::optional<TileNumber> tile;       // of each frame it alone
  bool resume = false;                  // keep the frames that are there
  std::optional<std::uint64_t> memory;  // [byte] that rendering may take; else default_memory where that is possible
  ImageFileOptions file;
  std::string stats_file;  // empty: none
  bool stats = false;
  bool quiet = false;    // print nothing but errors and what is asked for
  bool explain = false;  // print what would run, before it runs
};
constexpr std::uint64_t default_memory = std::uint64_t{4} << 30U;
int render(const RenderCommand&, Terminal&);
int explain(const RenderCommand&, Terminal&);

struct MergeCommand {
  std::vector<std::string> tiles;
  std::string output;
  ImageFileOptions file;
};
int merge(const MergeCommand&, Terminal&);

// Prints the commands that render the frames tile by tile, or merge the tiles, one a line.
struct PlanCommand {
  RenderCommand render;
  std::string program;        // how it was called
  std::string options;        // of rendering, as words of a shell, each after a space
  std::string merge_options;  // those that whole pictures take alone
  int tiles = 1;
  bool merge = false;
};
int print_plan(const PlanCommand&);

struct CompareCommand {
  std::string a, b;
  std::string image;     // empty: the main one
  double tolerance = 0;  // of the relative RMSE
};
int compare(const CompareCommand&);

struct EditCommand {
  std::string scene, script, output;
  std::string frames;  // as those of RenderCommand, but no "all"
  double fps = 24;
};
CLI::App* add_edit_command(CLI::App& program, EditCommand&);
int edit(const EditCommand&, Terminal&);

struct ViewCommand {
  std::string scene, output, record;
  std::optional<double> fog;  // [1/m] extinction in place of the scene's: the first edit
  RendererOptions renderer;
  Extent size{800, 600};  // of the picture
  float exposure = 0;     // [stops] at first
};
// `size`: text of the flag.
CLI::App* add_view_command(CLI::App& program, ViewCommand&, std::string& size);
int view(const ViewCommand&, Terminal&);

struct ConvertCommand {
  std::string input;   // glTF, or a mesh
  std::string output;  // a scene file
  std::optional<double> fog;
};
int convert(const ConvertCommand&, Terminal&);

struct FitCommand {
  std::string input;              // OpenVDB or NRRD
  std::string name = "density";   // of its grid
  std::string output;             // PLY
  int count = 1000, steps = 400;  // FitOptions
  int threads = 0;
  bool quiet = false;
};
int fit(const FitCommand&, Terminal&);

// Of the machine.
int info();
// Of a scene, a grid, Gaussians or a mesh, by the name's extension.
int info_of_file(const std::string& path, Progress&);

}  // namespace airlight
