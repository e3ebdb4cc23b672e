// airlight-splats: the rows of Szirmay-Kalos et al. 2005 (section 4, figures 5 to 8) at 512 x 512: frames a second with lights
// that move, one round of the iteration a frame as there and as many as the tolerance asks for, and what each step takes; the
// source function from the same network beside it.
//   airlight-splats [FRAMES]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "tests/truth/network_error.h"

namespace airlight {

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Row {
  int particles, paper;  // the paper's frames a second
};
constexpr Row paper_rows[] = {{1024, 26}, {512, 45}};
constexpr const char* steps[] = {"particle_light", "network_iteration", "source_function", "ray_march", "particle_splats"};

// The cloud of the truth tests, 20 mean free paths across, under two suns, which turn where `lights`.
Scene cloud(int frame, bool lights, bool camera) {
  Scene scene = network_cloud(20, 0.9, 0);
  scene.camera.resolution = {512, 512};
  const double turn = lights ? 0.01 * frame : 0, aside = camera ? 0.01 * frame : 0;
  scene.lights = {directional_light({-1 + turn, -1, -0.3}, glm::dvec3(2)), directional_light({1, 1 - turn, -0.5}, glm::dvec3(1))};
  scene.camera.position.x += aside;
  return scene;
}

void measure(const Row& row, const char* image, const char* iterations, bool lights, bool camera, const std::string& backend,
             int frames) {
  Renderer renderer({.backend = backend});
  RenderSettings settings;
  settings.technique = "illumination-network";
  settings.knobs = {
      {"particles", std::to_string(row.particles)}, {"directions", "128"}, {"image", image}, {"iterations", iterations}};
  std::vector<double> wall;
  std::vector<std::vector<double>> step(std::size(steps));
  double rounds = 0;
  for (int i = -2; i < frames; ++i) {  // two to warm up
    const Scene scene = cloud(i, lights, camera);
    const auto start = std::chrono::steady_clock::now();
    const Frame frame = renderer.render(scene, settings);
    if (i < 0) continue;
    wall.push_back(1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    for (std::size_t s = 0; s < std::size(steps); ++s) {
      double of_step = 0;
      for (const StepStats& stats : frame.stats.steps) {
        if (stats.name != steps[s] || stats.reused) continue;
        of_step += 1e3 * stats.seconds;
        if (!stats.residuals.empty()) rounds = static_cast<double>(stats.residuals.size());
      }
      step[s].push_back(of_step);
    }
  }
  const char* moves = lights ? camera ? "both" : "lights" : "camera";
  fmt::print("{:4} {:9} {:>7} {:>7} {:6.0f} {:6} {:10.1f} {:8.2f}", backend, row.particles, image, moves, rounds, row.paper,
             1e3 / median(wall), median(wall));
  for (const std::vector<double>& s : step) fmt::print(" {:17.2f}", median(s));
  fmt::print("\n");
  std::fflush(stdout);
}

void table(int frames) {
  fmt::print(
      "A cloud of optical depth 20, albedo 0.9, 128 directions, 512 x 512; medians of {} frames [ms], of steps over the "
      "screen the time of all threads together\n",
      frames);
  fmt::print("{:4} {:>9} {:>7} {:>7} {:>6} {:>6} {:>10} {:>8}", "", "particles", "image", "moves", "rounds", "paper", "frames/s",
             "frame");
  for (const char* s : steps) fmt::print(" {:>17}", s);
  fmt::print("\n");
  for (const Row& row : paper_rows) {
    measure(row, "splats", "1", true, false, "cpu", frames);
    measure(row, "splats", "200", true, false, "cpu", frames);
    measure(row, "splats", "1", true, true, "cpu", frames);
    measure(row, "splats", "1", false, true, "cpu", frames);
    measure(row, "source", "1", true, false, "cpu", frames);
    try {
      measure(row, "splats", "1", true, false, "gl", std::min(frames, 5));
    } catch (const MachineError& error) {
      fmt::print("# no gl: {}\n", error.what());
    }
  }
}

}  // namespace

}  // namespace airlight

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::atoi(argv[1]) : 31;
  if (argc > 2 || frames < 1) {
    fmt::print(stderr, "airlight-splats [FRAMES]: expected at least one frame\n");
    return 2;
  }
  airlight::table(frames);
  return 0;
}
