// Whole frames of scene files: every backend side by side in one run, interleaved so that the machine's noise hits all alike;
// medians.
//   airlight-frames [--repeats N] [--csv FILE] SCENE...
// The file gets a line a figure: scene, row, "frame", "steps" or the name of a step, milliseconds.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "app/airlight.h"
#include "common/scene/temporary_file.h"
#include "common/techniques/technique.h"
#include "cpu/targets.h"

namespace airlight {

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

struct Row {
  std::string name;
  Renderer renderer;
  bool moves;         // the camera moves from frame to frame, else a lamp flickers
  bool slow = false;  // a frame takes more than a second: three are enough
  std::vector<double> wall, steps;
  std::vector<std::pair<std::string, std::vector<double>>> step{};
};

std::vector<Row> rows() {
  std::vector<Row> all;
  const auto cpu = [&](const std::string& simd, int threads, bool moves) {
    all.push_back({fmt::format("cpu {} {} threads{}", simd, threads, moves ? ", moving camera" : ""),
                   Renderer({.backend = "cpu", .simd = simd, .threads = threads, .keep = 0}),
                   moves,
                   false,
                   {},
                   {}});
  };
  const std::vector<Simd> there = available_simd();
  const auto has = [&](Simd s) { return std::find(there.begin(), there.end(), s) != there.end(); };
  if (has(Simd::avx512)) cpu("avx512", 2, false), cpu("avx512", 2, true), cpu("avx512", 1, false);
  if (has(Simd::avx2)) cpu("avx2", 2, false);
  cpu("scalar", 2, false);
  try {
    all.push_back({"gl", Renderer({.backend = "gl", .keep = 0}), false, false, {}, {}});
    all.push_back({"gl, moving camera", Renderer({.backend = "gl", .keep = 0}), true, false, {}, {}});
  } catch (const MachineError& error) {
    fmt::print("# no gl: {}\n", error.what());
  }
  return all;
}

// The first real-time technique that renders the scene, whatever the scene asks for: the reference is no technique to time.
const Technique* technique_for(const Scene& scene) {
  for (const Technique& t : techniques()) {
    if (t.plan && !t.refuses(scene)) return &t;
  }
  return nullptr;
}

// Appends to `csv`.
void measure(const std::string& path, int repeats, std::string& csv) {
  const Scene loaded = load_scene(path);
  const Technique* technique = technique_for(loaded);
  if (!technique) {
    fmt::print("{}: no technique renders it\n\n", path);
    return;
  }
  RenderSettings settings;
  settings.technique = technique->name;
  std::vector<Row> all = rows();
  fmt::print("{}, {}, {} x {}, median of {} frames, of 3 above a second [ms]\n", path, technique->name,
             loaded.camera.resolution.width, loaded.camera.resolution.height, repeats);
  for (const Row& row : all) fmt::print("# {}: {}\n", row.name, row.renderer.describe());
  for (int i = -2; i < repeats; ++i) {  // two to warm up
    for (Row& row : all) {
      if (row.slow && (i == -1 || i > 2)) continue;
      Scene scene = loaded;
      const double change = 1e-5 * (i + 3);
      if (row.moves) {
        scene.camera.position.x += change;
      } else {
        for (LightSource& l : scene.lights) l.power *= 1 + change;
      }
      const auto start = std::chrono::steady_clock::now();
      const Frame frame = row.renderer.render(scene, settings);
      const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (i == -2) row.slow = wall > 1;
      if (i < 0) continue;
      row.wall.push_back(1e3 * wall);
      row.steps.push_back(1e3 * frame.stats.seconds);
      row.step.resize(frame.stats.steps.size());
      for (std::size_t s = 0; s < row.step.size(); ++s) {
        row.step[s].first = frame.stats.steps[s].name;
        row.step[s].second.push_back(1e3 * frame.stats.steps[s].seconds);
      }
    }
  }
  fmt::print("{:36} {:>8} {:>8}", "", "frame", "steps");
  for (const auto& step : all[0].step) fmt::print(" {:>22}", step.first);
  fmt::print("\n");
  for (const Row& row : all) {
    fmt::print("{:36} {:8.2f} {:8.2f}", row.name, median(row.wall), median(row.steps));
    for (const auto& step : row.step) fmt::print(" {:22.2f}", median(step.second));
    fmt::print("\n");
  }
  const auto gl = std::find_if(all.begin(), all.end(), [](const Row& r) { return r.name == "gl"; });
  const std::string name = std::filesystem::path(path).stem().string();
  for (const Row& row : all) {
    const auto line = [&](const std::string& what, const std::vector<double>& times) {
      csv += fmt::format("\"{}\",\"{}\",{},{:.4g}\n", name, row.name, what, median(times));
    };
    line("frame", row.wall);
    line("steps", row.steps);
    for (const auto& step : row.step) line(step.first, step.second);
  }
  if (gl == all.end()) return;
  fmt::print("gl / first row: frame {:.1f}", median(gl->wall) / median(all[0].wall));
  // CPU steps are thread time summed over the workers: beside GL's wall time on the same cores they are halved by two threads.
  for (std::size_t s = 0; s < all[0].step.size(); ++s) {
    fmt::print(", {} {:.1f}", all[0].step[s].first, 2 * median(gl->step[s].second) / median(all[0].step[s].second));
  }
  fmt::print("\n\n");
}

}  // namespace

}  // namespace airlight

int main(int argc, char** argv) {
  using namespace airlight;
  int repeats = 15;
  std::string csv_file, csv = "scene,row,what,ms\n";
  std::vector<std::string> scenes;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--repeats" && i + 1 < argc) {
      repeats = std::max(1, std::atoi(argv[++i]));
    } else if (word == "--csv" && i + 1 < argc) {
      csv_file = argv[++i];
    } else {
      scenes.emplace_back(word);
    }
  }
  try {
    for (const std::string& scene : scenes) measure(scene, repeats, csv);
    if (!csv_file.empty()) {
      TemporaryFile file(csv_file);
      file.write(csv.data(), csv.size());
      file.rename_to_target();
    }
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
  return 0;
}
