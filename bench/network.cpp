// airlight-network: the error of illumination-network beside the reference's random paths, by optical depth, albedo and phase
// function, and its decay with particles and directions, evenly spread and random; of small clouds far apart; of Gaussians that
// are a particle each; what both take for the same error.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

#include "tests/truth/network_error.h"

namespace airlight {

namespace {

constexpr Extent small{12, 12}, full{512, 512};

const NetworkSize sizes[] = {{1024, 128, 32}, {4096, 64, 64}, {4096, 256, 64}, {16384, 256, 128}};

// All rows, or the one that is named by its depth, albedo and g.
void errors(int paths, const std::string& row) {
  fmt::print(
      "Five Gaussians, a lamp and the sun, {} x {} pixels. Relative RMSE in percent beside the reference's paths, their noise\n"
      "taken off, and the mean beside theirs; by particles, directions and cells of the source function\n",
      small.width, small.height);
  fmt::print("{:>5} {:>6} {:>4} {:>9} {:>7}", "depth", "albedo", "g", "multiple", "noise");
  for (const NetworkSize& s : sizes) fmt::print("{:>18}", fmt::format("{}, {}, {}", s.particles, s.directions, s.resolution));
  fmt::print("\n");
  for (const double g : {0.0, 0.8}) {
    for (const double depth : {1.0, 4.0, 10.0, 40.0}) {
      if (g > 0 && depth == 4) continue;
      for (const double albedo : {0.5, 0.9, 0.99}) {
        if (!row.empty() && row != fmt::format("{},{},{}", depth, albedo, g)) continue;
        const Scene scene = network_cloud(depth, albedo, g);
        // Little of what a path meets is scattered forward to the camera, but much where it is.
        const NetworkTruth truth = network_truth(scene, small, g > 0 ? 4 * paths : paths);
        fmt::print("{:5} {:6} {:4} {:7.0f} % {:7.2f}", depth, albedo, g, 100 * (1 - truth.single / truth.mean),
                   100 * truth.noise);
        for (const NetworkSize& s : sizes) {
          const NetworkError e = network_error(scene, truth, s);
          fmt::print("{:11.2f} {:6.3f}", 100 * e.error, e.mean);
          std::fflush(stdout);
        }
        fmt::print("\n");
      }
    }
  }
}

// The smallest network below 5 %, from nothing to a picture; the paths that leave a noise of 5 %, of which a pixel of a small
// picture takes as long as one of a large one.
void times(int paths) {
  fmt::print("\nSeconds to a relative RMSE of 5 % at {} x {}, on {} threads: network, paths (from {} a pixel of {} x {})\n",
             full.width, full.height, std::thread::hardware_concurrency(), paths, small.width, small.height);
  for (const double depth : {4.0, 10.0}) {
    const Scene scene = network_cloud(depth, 0.9, 0);
    const NetworkTruth truth = network_truth(scene, small, paths);
    const double needed = paths * std::pow(truth.noise / 0.05, 2);
    const double pixels = static_cast<double>(full.width) * full.height / (static_cast<double>(small.width) * small.height);
    const double of_paths = (truth.seconds_all - truth.seconds_once) / paths * needed * pixels;
    for (const NetworkSize& s : {NetworkSize{256, 64, 16}, NetworkSize{512, 64, 32}, NetworkSize{1024, 64, 32},
                                 NetworkSize{2048, 64, 32}, NetworkSize{4096, 64, 32}, NetworkSize{4096, 256, 64}}) {
      const NetworkError e = network_error(scene, truth, s);
      if (!(e.error <= 0.05)) continue;
      Renderer renderer({.backend = "cpu"});
      const auto start = std::chrono::steady_clock::now();
      renderer.render(scene, network_settings(s, full));
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      fmt::print(
          "depth {}, albedo 0.9, isotropic: {:.3f} ({} particles, {} directions, {} cells: {:.1f} %), {:.0f} ({:.0f} paths a "
          "pixel): "
          "{:.0f} times\n",
          depth, seconds, s.particles, s.directions, s.resolution, 100 * e.error, of_paths, needed, of_paths / seconds);
      break;
    }
  }
}

// Directions spread evenly beside random ones.
void direction_sets(int paths) {
  fmt::print("\nDepth 4, albedo 0.9, 4096 particles, 64 cells: relative RMSE in percent and mean, by directions\n{:>4} {:>10}",
             "g", "set");
  constexpr int directions[] = {16, 64, 256, 1024};
  for (const int d : directions) fmt::print("{:>18}", d);
  fmt::print("\n");
  for (const double g : {0.0, 0.8}) {
    const Scene scene = network_cloud(4, 0.9, g);
    const NetworkTruth truth = network_truth(scene, small, g > 0 ? 4 * paths : paths);
    for (const char* set : {"fibonacci", "random"}) {
      fmt::print("{:4} {:>10}", g, set);
      for (const int d : directions) {
        const NetworkError e = network_error(scene, truth, {4096, d, 64, set});
        fmt::print("{:11.2f} {:6.3f}", 100 * e.error, e.mean);
        std::fflush(stdout);
      }
      fmt::print("\n");
    }
  }
}

// Two small clouds, by how far they are from each other.
void far_clouds(int paths) {
  fmt::print(
      "\nTwo Gaussians of radius 0.05 m, 8 x 6 pixels: relative RMSE in percent and mean, by particles; seconds of the last\n");
  fmt::print("{:>14} {:>7}", "apart [m]", "noise");
  constexpr int particles[] = {1024, 4096, 16384};
  for (const int n : particles) fmt::print("{:>18}", n);
  fmt::print("\n");
  for (const glm::dvec3& apart : {glm::dvec3(10, 0, 0), glm::dvec3(6, -6, -6), glm::dvec3(0.3, 0, 0)}) {
    const Scene scene = small_clouds(apart);
    const NetworkTruth truth = network_truth(scene, {8, 6}, paths);
    fmt::print("{:>14} {:7.2f}", fmt::format("{}, {}, {}", apart.x, apart.y, apart.z), 100 * truth.noise);
    double seconds = 0;
    for (const int n : particles) {
      const auto start = std::chrono::steady_clock::now();
      const NetworkError e = network_error(scene, truth, {n, 256, 32});
      seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      fmt::print("{:11.2f} {:6.3f}", 100 * e.error, e.mean);
      std::fflush(stdout);
    }
    fmt::print("{:9.2f}\n", seconds);
  }
}

// A ball of equal Gaussians, each one particle, beside as many sampled ones and the default.
void each_gaussian(int paths) {
  fmt::print("\nA ball of Gaussians, albedo 0.9, isotropic, 12 x 12 pixels: relative RMSE in percent and mean, by particles\n");
  fmt::print("{:>9} {:>7}{:>18}{:>18}{:>18}\n", "gaussians", "noise", "one each", "as many sampled", "4096 sampled");
  for (const int count : {64, 256}) {
    const Scene scene = particle_cloud(count);
    const NetworkTruth truth = network_truth(scene, small, paths);
    fmt::print("{:9} {:7.2f}", count, 100 * truth.noise);
    for (const NetworkSize& s :
         {NetworkSize{count, 256, 32, "fibonacci", "gaussians"}, NetworkSize{count, 256, 32}, NetworkSize{4096, 256, 32}}) {
      const NetworkError e = network_error(scene, truth, s);
      fmt::print("{:11.2f} {:6.3f}", 100 * e.error, e.mean);
      std::fflush(stdout);
    }
    fmt::print("\n");
  }
}

}  // namespace

}  // namespace airlight

int main(int argc, char** argv) {
  const int paths = argc > 1 ? std::atoi(argv[1]) : 2000;
  const std::string part = argc > 2 ? argv[2] : "", row = argc > 3 ? argv[3] : "";
  const std::pair<std::string, std::function<void()>> parts[] = {{"errors", [&] { airlight::errors(paths, row); }},
                                                                 {"directions", [&] { airlight::direction_sets(paths); }},
                                                                 {"far", [&] { airlight::far_clouds(paths); }},
                                                                 {"gaussians", [&] { airlight::each_gaussian(paths); }},
                                                                 {"times", [&] { airlight::times(paths); }}};
  const bool known = std::any_of(std::begin(parts), std::end(parts), [&](const auto& p) { return p.first == part; });
  if (argc > 4 || paths < 2 || (!part.empty() && !known)) {
    fmt::print(stderr,
               "airlight-network [PATHS [errors [DEPTH,ALBEDO,G]|directions|far|gaussians|times]]: expected at least 2 paths a "
               "pixel\n");
    return 2;
  }
  for (const auto& [name, measure] : parts) {
    if (part.empty() || part == name) measure();
  }
  return 0;
}
