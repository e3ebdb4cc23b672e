// The commands of the program `airlight`, each in its own file. Each returns its exit code and throws what the library throws.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/airlight.h"
#include "app/terminal.h"

namespace airlight {

struct RenderCommand {
  std::string scene;
  std::string output;
  RendererOptions renderer;
  RenderSettings settings;
  std::vector<std::string> aovs;
  std::string frames;   // "12", "0-47", "0-47x4" (every fourth), "all"; empty: the first, and names are taken as they are
  bool resume = false;  // keep the frames that are there
  ImageFileOptions file;
  std::string stats_file;  // empty: none
  bool stats = false;
  bool quiet = false;    // print nothing but errors and what is asked for
  bool explain = false;  // print what would run, before it runs
};
int render(const RenderCommand&, Terminal&);
int explain(const RenderCommand&, Terminal&);

struct CompareCommand {
  std::string a, b;
  std::string image;     // empty: the main one
  double tolerance = 0;  // of the relative RMSE
};
int compare(const CompareCommand&);

// Of the machine; of a scene file, unless its name is empty.
int info(const std::string& scene);

}  // namespace airlight
