// airlight-pareto: time against error of every technique and backend that renders a scene.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <list>
#include <thread>

#include "app/airlight.h"
#include "app/terminal.h"
#include "bench/pareto/files.h"
#include "bench/pareto/options.h"
#include "bench/pareto/plot.h"
#include "common/scene/temporary_file.h"

namespace airlight {

namespace {

struct NamedScene {
  std::string name;  // of its files
  Scene scene;
  KnobValues truth;
};

// Every scene and everything asked of it, before any work: what is wrong is told while nothing has been written.
std::vector<NamedScene> loaded(const Options& o, Terminal& terminal) {
  std::vector<NamedScene> all;
  for (const std::string& path : o.scenes) {
    Scene scene = load_scene(path, terminal);
    std::vector<std::string> refused;
    if (configurations(scene, o.measure.truth_extent, o.measure.techniques, {"cpu"}, refused).empty()) {
      std::string reasons;
      for (const std::string& r : refused) reasons += "; " + r;
      throw InputError(path + ": no technique renders it" + reasons);
    }
    KnobValues truth = truth_knobs(scene, o.truth);
    all.push_back({stem_of(path), std::move(scene), std::move(truth)});
  }
  return all;
}

// None of the files appears before all are complete.
void write(const std::string& folder, const std::string& name, const Measurement& m, const Origin& origin) {
  const Figure figure = figure_of(m, origin);
  std::filesystem::create_directories(folder);
  std::list<TemporaryFile> files;
  const auto add = [&](const std::string& extension, const std::string& bytes) {
    files.emplace_back(folder + "/" + name + extension);
    files.back().write(bytes.data(), bytes.size());
  };
  add(".csv", csv_of(m, origin));
  add(".json", json_of(m, origin));
  add(".svg", figure.svg);
  add(".png", figure.png);
  for (TemporaryFile& file : files) file.rename_to_target();
}

void print_front(const Measurement& m) {
  std::vector<Point> on;
  std::copy_if(m.points.begin(), m.points.end(), std::back_inserter(on), [](const Point& p) { return p.on_front; });
  std::stable_sort(on.begin(), on.end(), [](const Point& a, const Point& b) { return a.ms < b.ms; });
  for (const Point& p : on) {
    const Configuration& c = p.configuration;
    fmt::print("  {:<14} {:<4} {:>10.2f} ms {:>10.4g} %   {}\n", c.technique, c.backend, p.ms, 100 * p.error.everywhere,
               text_of(c.knobs));
  }
}

std::string line_of(const Point& p) {
  const Configuration& c = p.configuration;
  return fmt::format("{} on {}, {}: {:.4g} ms, {:.3g} %", c.technique, c.backend, text_of(c.knobs), p.ms,
                     100 * p.error.everywhere);
}

// One line; whether the goal is met.
bool print_choice(const std::string& name, const Measurement& m, const Goal& goal) {
  if (const Point* best = chosen(m.points, goal)) {
    fmt::print("{}: {}\n", name, line_of(*best));
    return true;
  }
  const Point* near = nearest(m.points, goal);
  fmt::print("{}: nothing meets it; {}\n", name, near ? "nearest: " + line_of(*near) : "nothing was timed");
  return false;
}

// Whether the goal, if there is one, is met.
bool measure_one(const NamedScene& s, const Options& o, Deadline& deadline, Terminal& terminal) {
  MeasureOptions options = o.measure;
  options.extent = o.resolution.value_or(s.scene.camera.resolution);
  const int threads = options.threads > 0 ? options.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const Truth truth = truth_of(s.scene, options.truth_extent, s.truth, o.cache, threads, deadline);
  if (truth.black()) throw InputError(s.name + ": the true image is black, errors relative to it mean nothing");
  const Measurement m = measure(s.scene, truth, options, deadline);

  Origin origin;
  origin.scene = s.name;
  origin.extent = options.extent, origin.truth_extent = options.truth_extent;
  for (const auto& [name, value] : s.truth.all()) origin.truth_knobs[name] = value;
  add_machine(origin);
  write(o.out, s.name, m, origin);
  for (const std::string& line : m.left_out) terminal.log(LogLevel::warning, s.name + ": left out: " + line);
  if (o.goal) return print_choice(s.name, m, o.goal);
  fmt::print("{}, {} x {}\n", s.name, options.extent.width, options.extent.height);
  print_front(m);
  return true;
}

int run(int argc, char** argv) {
  const std::optional<Options> o = options_of(argc, argv);
  if (!o) return 0;
  static Terminal terminal(LogLevel::warning);  // outlives the thread that waits for signals
  stop_on_signals(terminal);
  const std::vector<NamedScene> scenes = loaded(*o, terminal);
  const auto start = std::chrono::steady_clock::now();
  bool met = true;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    // What is left of the time, in equal parts.
    const double used = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Deadline deadline(terminal, (o->limit - used) / static_cast<double>(scenes.size() - i));
    try {
      met = measure_one(scenes[i], *o, deadline, terminal) && met;
    } catch (const Interrupted&) {
      if (terminal.stop_requested()) throw;
      throw MachineError(scenes[i].name + ": the time is over before the true image is there");
    }
    std::fflush(stdout);
  }
  return met ? 0 : 1;
}

}  // namespace

}  // namespace airlight

int main(int argc, char** argv) {
  const auto fail = [](const std::exception& e, int code) {
    fmt::print(stderr, "{}\n", e.what());
    return code;
  };
  try {
    return airlight::run(argc, argv);
  } catch (const airlight::InputError& e) {
    return fail(e, 2);
  } catch (const airlight::Interrupted& e) {
    return fail(e, 130);
  } catch (const std::exception& e) {
    return fail(e, 3);
  }
}
