// airlight-propagation: opacity propagation as tables for docs/RESULTS.md: the rows of Giroud and Biri's tables 2 and 3 at their
// size; schemes and resolutions, time against the error of depths; how the steps scale with cells, lights and Gaussians.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/airlight.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

constexpr Extent full{800, 600};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Blobs that fill a cube of edge 2 which fills the picture, lamps around it; radii fall with the number so that it stays as full.
Scene cloud(int gaussians, int lights) {
  Scene scene;
  scene.camera = {.position = {0, 0, 4.2}, .look_at = {0, 0, 0}, .vertical_fov = 40};
  scene.camera.resolution = full;
  scene.sky_distance = 100;
  const double radius = 0.42 / std::cbrt(gaussians);
  for (int i = 0; i < gaussians; ++i) {
    const auto place = [&](std::uint32_t axis) {
      return (1 - 3 * radius) * (2 * uniform(900, 3 * static_cast<std::uint32_t>(i) + axis) - 1);
    };
    scene.medium.gaussians.push_back({.center = {place(0), place(1), place(2)}, .radius = radius, .extinction = 0.8 / 0.42});
  }
  for (int i = 0; i < lights; ++i) {
    const double angle = 2.4 * i;
    LightSource lamp;
    lamp.position = {2 * std::cos(angle), 0.8 + 0.1 * i, 2 * std::sin(angle)};
    lamp.power = glm::dvec3(9) / static_cast<double>(lights);
    scene.lights.push_back(lamp);
  }
  return scene;
}

enum class Moves { camera, all };

struct Times {
  double frame = 0, injection = 0, propagation = 0, march = 0;  // [ms]; the steps' of all threads together
};

Times frame_times(const Scene& loaded, int resolution, const char* scheme, Moves moves, const std::string& backend = "cpu",
                  const char* steps = "16", const char* airlight = "full") {
  Renderer renderer({.backend = backend});
  RenderSettings settings;
  settings.technique = "opacity-propagation";
  settings.knobs = {{"resolution", std::to_string(resolution)}, {"scheme", scheme}, {"density", "volume"}, {"steps", steps}};
  settings.knobs.emplace_back("airlight_resolution", airlight);
  std::vector<double> frame, injection, propagation, march;
  for (int i = -1; i < 9; ++i) {
    Scene scene = loaded;
    const double change = 1e-4 * (i + 2);
    scene.camera.position.x += change;
    if (moves == Moves::all) {
      for (LightSource& l : scene.lights) l.position.y += change;
      for (std::size_t g = 0; g < scene.medium.gaussians.size(); ++g)
        scene.medium.gaussians[g].center.y += (g % 2 == 0 ? 1 : -1) * change;
    }
    const auto start = std::chrono::steady_clock::now();
    const Frame made = renderer.render(scene, settings);
    if (i < 0) continue;
    frame.push_back(1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    double of[3] = {};
    for (const StepStats& s : made.stats.steps) {
      const char* names[3] = {"density_injection", "optical_depth_propagation", "ray_march"};
      for (int n = 0; n < 3; ++n) of[n] += s.name == names[n] && !s.reused ? 1e3 * s.seconds : 0;
    }
    injection.push_back(of[0]), propagation.push_back(of[1]), march.push_back(of[2]);
  }
  return {median(frame), median(injection), median(propagation), median(march)};
}

void table_two() {
  fmt::print("Giroud and Biri, table 2, 800 x 600, 16 steps, by airlight_resolution: frames a second, the paper's in brackets\n");
  fmt::print("{:>6} {:>8} {:>18} {:>16} {:>16} {:>16} {:>16}\n", "cells", "airlight", "only the camera", "1 light moves",
             "2 lights", "4 lights", "8 lights");
  const int paper[4][6] = {{15, 320, 62, 62, 51, 34}, {20, 251, 38, 37, 35, 22}, {30, 203, 17, 17, 16, 9}, {40, 120, 9, 9, 9, 5}};
  for (const auto& row : paper) {
    for (const char* airlight : {"full", "half", "quarter"}) {
      const auto frames = [&](int lights, Moves moves) {
        return 1e3 / frame_times(cloud(8, lights), row[0], "rays", moves, "cpu", "16", airlight).frame;
      };
      fmt::print("{:4}^3 {:>8}", row[0], airlight);
      fmt::print(" {:10.0f} ({:4})", frames(1, Moves::camera), row[1]);
      for (int k = 0; k < 4; ++k) fmt::print(" {:9.0f} ({:3})", frames(1 << k, Moves::all), row[2 + k]);
      fmt::print("\n");
    }
  }
}

void table_three() {
  fmt::print(
      "\nTheir table 3: Gaussians in 20^3 cells, one light; frames a second, the paper's in brackets, and ten times its "
      "largest\n");
  fmt::print("{:>10} {:>16} {:>16} {:>14} {:>14}\n", "Gaussians", "all moves", "only the camera", "injection ms", "march ms");
  const int paper[6][3] = {{1, 38, 251}, {125, 36, 250}, {1000, 35, 252}, {8000, 22, 215}, {27000, 9, 142}, {270000, 0, 0}};
  for (const auto& row : paper) {
    const int n = row[0];
    const auto printed = [](int frames) { return frames > 0 ? fmt::format("({:3})", frames) : std::string(5, ' '); };
    const Scene scene = cloud(n, 1);
    const Times all = frame_times(scene, 20, "rays", Moves::all), camera = frame_times(scene, 20, "rays", Moves::camera);
    fmt::print("{:10} {:10.0f} {} {:10.0f} {} {:14.2f} {:14.2f}\n", n, 1e3 / all.frame, printed(row[1]), 1e3 / camera.frame,
               printed(row[2]), all.injection, camera.march);
  }
}

void scaling() {
  fmt::print("\nThread milliseconds of the steps, by cells and lights, forty Gaussians; nodes a second and core\n");
  fmt::print("{:>6} {:>7} {:>8} {:>12} {:>12} {:>12} {:>12}\n", "cells", "lights", "scheme", "injection", "propagation",
             "M cells/s", "M nodes/s");
  const auto line = [](int n, int lights, const char* scheme) {
    const Times t = frame_times(cloud(40, lights), n, scheme, Moves::all, "cpu", "1");
    const double cells = std::pow(n, 3);
    fmt::print("{:4}^3 {:7} {:>8} {:12.3f} {:12.3f} {:12.0f} {:12.0f}\n", n, lights, scheme, t.injection, t.propagation,
               1e-3 * cells / t.injection, 1e-3 * cells * lights / t.propagation);
  };
  for (const int n : {16, 32, 64, 128, 256}) line(n, 1, "rays");
  for (const int lights : {4, 16, 64}) line(32, lights, "rays");
  for (const char* scheme : {"upwind", "published"}) {
    for (const int n : {32, 64, 128}) line(n, 1, scheme);
  }
}

void beside_gl() {
  fmt::print("\nOpenGL on the same cores, 20^3 cells, one light, all moves: frame ms\n");
  const Times cpu = frame_times(cloud(8, 1), 20, "rays", Moves::all);
  try {
    const Times gl = frame_times(cloud(8, 1), 20, "rays", Moves::all, "gl");
    fmt::print("cpu {:.1f}, gl {:.1f}: {:.1f} times\n", cpu.frame, gl.frame, gl.frame / cpu.frame);
  } catch (const MachineError& error) {
    fmt::print("no gl: {}\n", error.what());
  }
}

}  // namespace

}  // namespace airlight

int main() {
  airlight::table_two();
  airlight::table_three();
  airlight::scaling();
  airlight::beside_gl();
  return 0;
}
