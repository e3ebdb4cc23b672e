// airlight-stress: hostile scenes by their numbers.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "tests/stability/formula_stress.h"
#include "tests/stability/hostile.h"
#include "tests/stability/trial.h"
#include "tests/stability/write_scene.h"
#include "tests/tolerances.h"

using namespace airlight;

namespace {

int usage() {
  std::fputs(
      "usage: airlight-stress FIRST COUNT [SECONDS]   tries so many scenes from a number on, at most so long; 1 where any fails\n"
      "       airlight-stress --formulas STREAM CALLS [NAME]  calls each formula so often, those whose truth takes long more "
      "rarely, with numbers of a stream, or those alone whose name begins so: tables; 1 where any is off\n"
      "       airlight-stress --write NUMBER FOLDER   writes one as scene.json, for: airlight render FOLDER/scene.json\n",
      stderr);
  return 2;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

int run(std::uint32_t first, std::uint32_t count, double limit) {
  const auto start = std::chrono::steady_clock::now();
  Trials trials;
  std::map<std::string, int> no_truth;
  std::uint32_t tried = 0, failed = 0, truths = 0, refused = 0;
  double worst_gl = 0;
  for (std::uint32_t number = first; number < first + count; ++number) {
    if (limit > 0 && seconds_since(start) > limit) break;
    const HostileScene hostile = hostile_scene(number);
    const Asked asked = asked_of(hostile.scene, number);
    ++tried;
    if (asked.technique.empty()) {
      ++refused;
      continue;
    }
    const auto began = std::chrono::steady_clock::now();
    const Trial trial = trials.run(hostile.scene, asked, number, {.gl = number % 8 == 0, .truth_pixels = 48, .seconds = 2});
    if (seconds_since(began) > 15) fmt::print("{}: slow, {:.0f} s\n", number, seconds_since(began));
    worst_gl = std::max(worst_gl, trial.gl_apart);
    truths += trial.truth ? 1 : 0;
    refused += trial.refused.empty() ? 0 : 1;
    if (!trial.why_no_truth.empty())
      ++no_truth[trial.why_no_truth.starts_with("the truth claims") ? "the truth is unsure" : trial.why_no_truth];
    if (trial.failures.empty()) continue;
    ++failed;
    fmt::print("{}: {}; {}\n", number, asked.text(), hostile.traits);
    for (const std::string& line : trial.failures) fmt::print("    {}\n", line);
    std::fflush(stdout);
  }
  fmt::print("airlight-stress: scenes {}..{}, {} failed, {} held to the truth, {} refused; CPU and GL at most {:.2g} apart\n",
             first, first + tried, failed, truths, refused, worst_gl);
  for (const auto& [why, number] : no_truth) fmt::print("  no truth of {}: {}\n", number, why);
  fmt::print("next {}\n", first + tried);
  return failed > 0 ? 1 : 0;
}

int run_formulas(std::uint32_t stream, std::size_t calls, std::string_view name) {
  constexpr std::size_t at_once = 100000;
  bool good = true;
  fmt::print("| formula | domain | largest error | of | allowed | at |\n|---|---|---|---|---|---|\n");
  std::size_t results = 0, pairs = 0;
  const std::vector<StressedFormula> formulas = stressed_formulas();
  for (const StressedFormula& f : formulas) {
    if (!f.name.starts_with(name)) continue;
    FormulaStress worst;
    for (std::size_t done = 0; done < calls; done += at_once) {
      const FormulaStress found = stress(f, stream + static_cast<std::uint32_t>(done / at_once), std::min(at_once, calls - done));
      results += found.measured.count;
      worst.not_finite += found.not_finite, worst.other_bits += found.other_bits;
      if (!(found.measured.error <= worst.measured.error)) worst.measured = found.measured;
    }
    const bool held = worst.measured.error <= tolerance(f.bound) && worst.not_finite == 0 && worst.other_bits == 0;
    good = good && held;
    fmt::print("| {} | {} | {:.2g} | {} | {:.2g}{} | {} |\n", f.name, f.domain, worst.measured.error, f.scale, tolerance(f.bound),
               held ? "" : fmt::format(" MISSED, {} not finite, {} of other bits", worst.not_finite, worst.other_bits),
               worst.measured.where);
    std::fflush(stdout);
  }
  // Neighbouring floats: 33 a place. Each of two may be off by its bound.
  fmt::print("\n| formula | neighbours | step back | at most | of | at |\n|---|---|---|---|---|---|\n");
  for (const StressedFormula& f : formulas) {
    if (f.rises == 0 || !f.name.starts_with(name)) continue;
    Monotony all;
    for (std::size_t done = 0; done < calls / 33; done += at_once / 33) {
      const Monotony found = monotony(f, stream + static_cast<std::uint32_t>(done), std::min(at_once / 33, calls / 33 - done));
      all.pairs += found.pairs, all.back += found.back;
      if (!(found.largest.error <= all.largest.error)) all.largest = found.largest;
    }
    const bool held = all.largest.error <= 2 * tolerance(f.bound);
    good = good && held;
    pairs += all.pairs;
    fmt::print("| {} | {} | {} | {:.2g}{} | {} | {} |\n", f.name, all.pairs, all.back, all.largest.error, held ? "" : " MISSED",
               f.scale, all.largest.where);
  }
  fmt::print("\n{} results held to the truth, {} pairs of neighbours\n", results, pairs);
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::string(argv[1]) == "--write") {
    const auto number = static_cast<std::uint32_t>(std::strtoul(argv[2], nullptr, 10));
    const HostileScene hostile = hostile_scene(number);
    const Asked asked = asked_of(hostile.scene, number);
    std::filesystem::create_directories(argv[3]);
    write_scene(argv[3], hostile.scene, asked.technique, asked.settings);
    fmt::print("{}/scene.json: {}; {}\n", argv[3], asked.text(), hostile.traits);
    return 0;
  }
  if ((argc == 4 || argc == 5) && std::string(argv[1]) == "--formulas")
    return run_formulas(static_cast<std::uint32_t>(std::strtoul(argv[2], nullptr, 10)), std::strtoul(argv[3], nullptr, 10),
                        argc == 5 ? argv[4] : "");
  if (argc != 3 && argc != 4) return usage();
  return run(static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)),
             static_cast<std::uint32_t>(std::strtoul(argv[2], nullptr, 10)), argc > 3 ? std::atof(argv[3]) : 0);
}
