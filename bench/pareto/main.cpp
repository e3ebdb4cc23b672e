// airlight-pareto: time against error of every technique and backend that renders a scene.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "app/airlight.h"
#include "app/terminal.h"
#include "bench/pareto/files.h"
#include "bench/pareto/plot.h"
#include "common/plan/goal.h"
#include "common/scene/temporary_file.h"

namespace airlight {

namespace {

struct Options {
  std::vector<std::string> scenes;
  MeasureOptions measure;
  std::string resolution, truth_resolution = "160x120", out = "build/bench/pareto", cache = "build/bench/truth",
                          commit = "unknown";
  std::string error, budget;
};

Extent extent_of(const std::string& flag, const std::string& text) {
  Extent e;
  int used = 0;
  if (std::sscanf(text.c_str(), "%6dx%6d%n", &e.width, &e.height, &used) != 2 || static_cast<std::size_t>(used) != text.size() ||
      e.width < 1 || e.height < 1) {
    throw InputError(flag + ": expected WIDTHxHEIGHT, found \"" + text + "\"");
  }
  return e;
}

void write(const std::string& path, const std::string& text) {
  TemporaryFile file(path);
  file.write(text.data(), text.size());
  file.rename_to_target();
}

void print(const Measurement& m) {
  for (const std::string& left_out : m.left_out) fmt::print("  left out: {}\n", left_out);
  std::vector<Point> on;
  for (const Point& p : m.points) {
    if (p.on_front) on.push_back(p);
  }
  std::sort(on.begin(), on.end(), [](const Point& a, const Point& b) { return a.ms < b.ms; });
  for (const Point& p : on) {
    const Configuration& c = p.configuration;
    fmt::print("  {:<14} {:<4} {:>10.2f} ms {:>10.4f} %   {}\n", c.technique, c.backend, p.ms, 100 * p.error.everywhere,
               text_of(c.knobs));
  }
}

std::string line_of(const Point& p) {
  const Configuration& c = p.configuration;
  return fmt::format("{} on {}, {}: {:.3g} ms, {:.3g} %", c.technique, c.backend, text_of(c.knobs), p.ms,
                     100 * p.error.everywhere);
}

// One line; whether the goal is met.
bool print_choice(const Measurement& m, const Goal& goal) {
  const Point* best = goal.error ? cheapest_within_error(m.points, *goal.error) : best_within_time(m.points, 1e3 * *goal.seconds);
  if (best) {
    fmt::print("{}\n", line_of(*best));
    return true;
  }
  const Point* nearest = nullptr;
  for (const Point& p : m.points) {
    if (p.ms <= 0) continue;
    const bool nearer = nearest && (goal.error ? p.error.everywhere < nearest->error.everywhere : p.ms < nearest->ms);
    if (!nearest || nearer) nearest = &p;
  }
  fmt::print("nothing meets it{}\n", nearest ? "; nearest: " + line_of(*nearest) : "");
  return false;
}

int run(int argc, char** argv) {
  Options o;
  CLI::App program("Time against error: sweeps the knobs of every technique on each backend, against the reference.",
                   "airlight-pareto");
  program.add_option("SCENE", o.scenes, "scene files")->required();
  program.add_option("--out", o.out, "folder for SCENE.csv, .json, .svg and .png")->capture_default_str();
  program.add_option("--cache", o.cache, "folder where true images are kept")->capture_default_str();
  program.add_option("--resolution", o.resolution, "WIDTHxHEIGHT of the timed frames instead of the camera's");
  program.add_option("--truth-resolution", o.truth_resolution, "WIDTHxHEIGHT at which errors are measured")
      ->capture_default_str();
  program.add_option("--backends", o.measure.backends, "cpu,gl")->delimiter(',')->capture_default_str();
  program.add_option("--techniques", o.measure.techniques, "instead of all, separated by commas")->delimiter(',');
  program.add_option("--threads", o.measure.threads, "threads of the CPU, 0: as many as there are")->check(CLI::Range(0, 1024));
  program.add_option("--repeats", o.measure.repeats, "timed frames of each configuration")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  program.add_option("--longest", o.measure.longest, "seconds; a frame that takes longer is timed once")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  program.add_option("--limit", o.measure.limit, "seconds a scene after which no further round of frames begins")
      ->check(CLI::PositiveNumber);
  program.add_flag("--everything", o.measure.everything, "time every configuration at full size, not only those near a front");
  program.add_option("--error", o.error,
                     "print the cheapest configuration with at most this error, 1% or 0.01; exit code 1 if there is none");
  program.add_option("--budget", o.budget,
                     "print the most exact configuration within this time, 30ms or 0.03s; exit code 1 if there is none");
  program.add_option("--commit", o.commit, "name of the sources, for the JSON file");
  program.footer(R"(Examples
  airlight-pareto scenes/fog_bunny.json
  airlight-pareto --backends cpu --error 1% scenes/smoke.json
  airlight-pareto --techniques marching --everything --out figures scenes/*.json
)");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return program.exit(e);
    throw InputError("airlight-pareto: " + std::string(e.what()) + " (airlight-pareto --help)");
  }
  const Goal goal = goal_of(o.error, o.budget);
  for (const std::string& t : o.measure.techniques) technique(t);
  for (const std::string& b : o.measure.backends) {
    if (b != "cpu" && b != "gl") throw InputError("unknown backend \"" + b + "\", expected cpu | gl");
  }
  o.measure.truth_extent = extent_of("--truth-resolution", o.truth_resolution);
  static Terminal terminal(LogLevel::warning);
  stop_on_signals(terminal);
  std::vector<Scene> scenes;
  for (const std::string& path : o.scenes) scenes.push_back(load_scene(path, terminal));
  std::filesystem::create_directories(o.out);
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  bool met = true;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    MeasureOptions options = o.measure;
    options.extent = o.resolution.empty() ? scenes[i].camera.resolution : extent_of("--resolution", o.resolution);
    const Truth truth = truth_of(scenes[i], options.truth_extent, o.cache, threads, terminal);
    const Measurement m = measure(scenes[i], truth, options, terminal);
    const std::string name = std::filesystem::path(o.scenes[i]).stem().string();
    const Origin origin{name, o.commit, machine_name(), options.extent, options.truth_extent};
    write(o.out + "/" + name + ".csv", csv_of(m, origin));
    write(o.out + "/" + name + ".json", json_of(m, origin));
    draw(m, fmt::format("{}, {} x {}", name, options.extent.width, options.extent.height), o.out + "/" + name);
    if (goal) {
      met = print_choice(m, goal) && met;
    } else {
      fmt::print("{}, {} x {}\n", name, options.extent.width, options.extent.height);
      print(m);
    }
    std::fflush(stdout);
  }
  return met ? 0 : 1;
}

}  // namespace

}  // namespace airlight

int main(int argc, char** argv) {
  try {
    return airlight::run(argc, argv);
  } catch (const airlight::InputError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  } catch (const airlight::Interrupted& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 130;
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 3;
  }
}
