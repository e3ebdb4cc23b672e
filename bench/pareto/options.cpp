#include "bench/pareto/options.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <set>

namespace airlight {

namespace {

constexpr const char* examples = R"(Examples
  airlight-pareto scenes/fog_bunny.json
  airlight-pareto --techniques marching --everything --out figures scenes/*.json
  airlight-pareto --backends cpu --error 1% scenes/smoke.json
  airlight-pareto --budget 30ms --limit 120 scenes/smoke.json
Of each scene there are SCENE.csv, SCENE.json, SCENE.svg and SCENE.png in the folder of --out afterwards. Errors are relative RMSE of
the image against the reference's, edges included; times are those of whole frames, warm.
)";

// Texts of flags that are more than a number or a list.
struct Texts {
  std::string truth_resolution = "160x120";
  std::optional<std::string> resolution, error, budget;
  std::vector<std::string> truth;
};

Extent extent_of(const std::string& flag, const std::string& text) {
  Extent e;
  int used = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%n", &e.width, &e.height, &used) != 2 || static_cast<std::size_t>(used) != text.size() ||
      e.width < 1 || e.height < 1 || e.width > 65535 || e.height > 65535) {
    throw InputError(flag + ": expected WIDTHxHEIGHT, 1..65535 pixels a side, found \"" + text + "\"");
  }
  return e;
}

std::pair<std::string, std::string> setting_of(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0) throw InputError("--truth-set: expected NAME=VALUE, found \"" + text + "\"");
  return {text.substr(0, at), text.substr(at + 1)};
}

void add_flags(CLI::App& program, Options& o, Texts& t) {
  MeasureOptions& m = o.measure;
  program.add_option("SCENE", o.scenes, "scene files")->required();
  program.add_option("--out", o.out, "folder for the results")->capture_default_str();
  program.add_option("--cache", o.cache, "folder where true images are kept")->capture_default_str();
  program.add_option("--techniques", m.techniques, "instead of all that render the scene, separated by commas")->delimiter(',');
  program.add_option("--backends", m.backends, "cpu,gl; one that cannot start is left out")
      ->delimiter(',')
      ->capture_default_str();
  program.add_option("--threads", m.threads, "threads of the CPU, 0: as many as there are")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  program.add_option("--simd", m.simd, "auto | scalar | avx2 | avx512 | neon")
      ->check(CLI::IsMember({"auto", "scalar", "avx2", "avx512", "neon"}))
      ->capture_default_str();
  program.add_option("--resolution", t.resolution, "WIDTHxHEIGHT of the timed frames instead of the camera's");
  program.add_option("--truth-resolution", t.truth_resolution, "WIDTHxHEIGHT at which errors are measured")
      ->capture_default_str();
  program.add_option("--truth-set", t.truth, "NAME=VALUE, a setting of the reference, as shadows=off; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  program.add_option("--repeats", m.repeats, "timed frames of each configuration")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  program.add_option("--longest", m.longest, "seconds; a frame that takes longer is timed once")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  program.add_option("--limit", o.limit, "seconds in all; what is not measured then is left out")->check(CLI::PositiveNumber);
  program.add_flag("--everything", m.everything, "time every configuration at full size, not only those near a front");
  program.add_option("--error", t.error, "print the cheapest configuration within this error (1%, 0.01); exit code 1 if none is");
  program.add_option("--budget", t.budget, "print the most exact one within this time (30ms, 0.03s); exit code 1 if none is");
  program.footer(examples);
}

void check(const Options& o) {
  for (const std::string& name : o.measure.techniques) {
    if (!technique(name).plan) throw InputError("--techniques: " + name + " is the truth itself, it has no front");
  }
  for (const std::string& b : o.measure.backends) {
    if (b != "cpu" && b != "gl") throw InputError("--backends: unknown backend \"" + b + "\", expected cpu | gl");
  }
  std::set<std::string> stems;
  for (const std::string& scene : o.scenes) {
    if (!stems.insert(stem_of(scene)).second)
      throw InputError(scene + ": another scene has the same name, and so the same files");
  }
}

}  // namespace

std::string stem_of(const std::string& scene) { return std::filesystem::path(scene).stem().string(); }

std::optional<Options> options_of(int argc, char** argv) {
  Options o;
  Texts texts;
  CLI::App program("Time against error: sweeps the knobs of every technique on each backend against the reference.",
                   "airlight-pareto");
  add_flags(program, o, texts);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0) throw InputError("airlight-pareto: " + std::string(e.what()) + " (airlight-pareto --help)");
    program.exit(e);
    return std::nullopt;
  }
  o.goal = goal_of(texts.error, texts.budget);
  if (texts.resolution) o.resolution = extent_of("--resolution", *texts.resolution);
  o.measure.truth_extent = extent_of("--truth-resolution", texts.truth_resolution);
  for (const std::string& t : texts.truth) o.truth.push_back(setting_of(t));
  check(o);
  return o;
}

}  // namespace airlight
