// airlight-network-rounds: what illumination networks cost by particles and directions, and how many rounds their light takes to
// settle, beside the iteration as it is published, which carries light over one link a round.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "cpu/backend.h"
#include "tests/parity/network.h"
#include "tests/truth/network_error.h"

namespace airlight {

namespace {

int window_of(int particles) { return static_cast<int>(std::lround(std::cbrt(particles))); }

struct Ran {
  Case all;
  TestNetwork network;
  StepStats steps[4];      // network, light, rounds, sources
  double milliseconds[4];  // of them on one core: what all threads took together
};

// Each step by itself: those before it are kept.
Ran run(CpuBackend& backend, const Scene& scene, const NetworkParts& parts) {
  Ran ran;
  ran.network = test_network(ran.all, scene, scene.lights, parts);
  ran.all.steps = {{ran.network.network, ""}, {ran.network.light, ""}, {ran.network.iteration, ""}, {ran.network.source, ""}};
  upload(backend, ran.all);
  NoProgress progress;
  for (std::size_t k = 0; k < 4; ++k) {
    Stats stats;
    const std::clock_t start = std::clock();
    backend.run(std::span(ran.all.steps).first(k + 1), stats, progress);
    ran.milliseconds[k] = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    ran.steps[k] = stats.steps[k];
  }
  return ran;
}

NetworkParts parts_of(const Scene& scene, int particles, int directions, float tolerance, int iterations) {
  return {.particles = particles,
          .lines = directions / 2,
          .window = window_of(particles),
          .phase = scene.medium.phase,
          .extinction = 0,
          .tolerance = tolerance,
          .iterations = iterations};
}

// The least of a few runs; of a round what more of them take.
void costs() {
  fmt::print(
      "Milliseconds of one core, of what {} threads took together, the least of 7 runs (of 3 from 16384 particles on);\n"
      "source function of 13 nodes along the longest edge; MiB that steps hand on\n",
      std::thread::hardware_concurrency());
  fmt::print("{:>9} {:>10} {:>4} {:>8} {:>8} {:>8} {:>9} {:>8} {:>6}\n", "particles", "directions", "g", "network", "light",
             "round", "set up", "sources", "MiB");
  for (const double g : {0.0, 0.6}) {
    const Scene scene = network_cloud(10, 0.9, g);
    for (const auto& [particles, directions] : {std::pair{512, 128},
                                                {1024, 128},
                                                {4096, 64},
                                                {4096, 128},
                                                {4096, 256},
                                                {16384, 64},
                                                {16384, 256},
                                                {100000, 64},
                                                {100000, 256}}) {
      const int few = 2, many = g > 0 ? 12 : 42;
      double least[4] = {1e9, 1e9, 1e9, 1e9}, of_many = 1e9;
      double bytes = 0;
      for (int i = 0; i < (particles < 16384 ? 7 : 3); ++i) {
        CpuBackend first(CpuOptions{}), second(CpuOptions{});
        const Ran ran = run(first, scene, parts_of(scene, particles, directions, 0, few));
        for (std::size_t k = 0; k < 4; ++k) least[k] = std::min(least[k], ran.milliseconds[k]);
        bytes = static_cast<double>(ran.network.network.links.bytes + 2 * ran.network.light.first.bytes);
        of_many = std::min(of_many, run(second, scene, parts_of(scene, particles, directions, 0, many)).milliseconds[2]);
      }
      const double round = (of_many - least[2]) / (many - few);
      fmt::print("{:9} {:10} {:4} {:8.2f} {:8.2f} {:8.3f} {:9.2f} {:8.2f} {:6.0f}\n", particles, directions, g, least[0],
                 least[1], round, least[2] - few * round, least[3], bytes / (1 << 20));
      std::fflush(stdout);
    }
  }
}

// The published iteration on the same links: I[p,i] = (1 - alpha) I[v,i] + alpha (first[v] + a_v mean of I[v,d] over d), v what p
// sees; isotropic, of the first channel. Gives the mean of all I after each round.
std::vector<double> published(CpuBackend& backend, const Ran& ran, int rounds) {
  const NetworkShape shape = ran.network.network.shape();
  const std::vector<float> links = download(backend, ran.network.network.links),
                           first = download(backend, ran.network.light.first);
  const std::size_t n = shape.particles, directions = 2 * shape.lines;
  std::vector<std::int32_t> seen(n * directions, -1);
  std::vector<float> alpha(n * directions, 0.0F), now(n * directions, 0.0F), next(n * directions, 0.0F), mean(n, 0.0F);
  for (std::size_t l = 0; l < shape.lines; ++l) {
    const float* begin = links.data() + l * (shape.slots + 1);
    for (std::size_t c = 0; c < shape.slots; ++c) {
      const auto at = [&](std::size_t k) { return static_cast<std::size_t>(links[shape.record(l, link_particle) + k + c]); };
      for (auto k = static_cast<std::size_t>(begin[c]); k + 1 < static_cast<std::size_t>(begin[c + 1]); ++k) {
        const std::size_t a = at(k), b = at(k + 1);
        const float lost = links[shape.record(l, link_lost) + k + 1 + c];
        seen[2 * l * n + b] = static_cast<std::int32_t>(a), alpha[2 * l * n + b] = lost;  // light goes from a to b
        seen[(2 * l + 1) * n + a] = static_cast<std::int32_t>(b), alpha[(2 * l + 1) * n + a] = lost;
      }
    }
  }
  const auto albedo = static_cast<float>(ran.network.network.gaussians[0].albedo.x);
  std::vector<double> means;
  for (int round = 0; round < rounds; ++round) {
    std::fill(mean.begin(), mean.end(), 0.0F);
    for (std::size_t d = 0; d < directions; ++d) {
      for (std::size_t v = 0; v < n; ++v) mean[v] += now[d * n + v] / static_cast<float>(directions);
    }
    double sum = 0;
    for (std::size_t k = 0; k < n * directions; ++k) {
      if (seen[k] < 0) continue;
      const auto v = static_cast<std::size_t>(seen[k]);
      next[k] = (1 - alpha[k]) * now[k - k % n + v] + alpha[k] * (first[4 * v] + albedo * mean[v]);
      sum += static_cast<double>(next[k]);
    }
    now.swap(next);
    means.push_back(sum);
  }
  return means;
}

// Rounds until no more than a share of the light is missing of what there is in the end.
int rounds_to(const std::vector<double>& sums, double share) {
  const auto enough = [&](double sum) { return sum >= (1 - share) * sums.back(); };
  return static_cast<int>(std::find_if(sums.begin(), sums.end(), enough) - sums.begin()) + 1;
}

// The iteration with 1024 particles and 128 directions, and the least time that it takes of a few runs.
struct Settled {
  std::unique_ptr<CpuBackend> backend;
  Ran ran;
  std::vector<double> sources;
  double milliseconds = 1e9;

  Settled(const Scene& scene, bool gradients, float tolerance, int iterations, int runs) {
    NetworkParts parts = parts_of(scene, 1024, 128, tolerance, iterations);
    parts.gradients = gradients;
    for (int i = 0; i < runs; ++i) {
      backend = std::make_unique<CpuBackend>(CpuOptions{.threads = 1});
      ran = run(*backend, scene, parts);
      milliseconds = std::min(milliseconds, ran.milliseconds[2]);
    }
    for (const float one : download(*backend, ran.network.iteration.sources)) sources.push_back(static_cast<double>(one));
  }

  // Of all sources together, beside what they are in the end.
  double off(const Settled& end) const {
    double sum = 0, all = 0;
    for (std::size_t k = 0; k < sources.size(); ++k) sum += std::fabs(sources[k] - end.sources[k]), all += end.sources[k];
    return sum / all;
  }
};

constexpr int runs = 7;

void convergence() {
  fmt::print(
      "\nRounds, 1024 particles and 128 directions, isotropic. Published: until 10 %, 1 % and 0.1 % of the light are missing.\n"
      "Orders of scattering, conjugate gradients: until 0.1 % are told to be left out, what all sources together then are off,\n"
      "and milliseconds of one thread of the whole step, the least of {} runs\n",
      runs);
  for (const double depth : {1.0, 10.0, 40.0}) {
    for (const double albedo : {0.5, 0.9, 0.99, 1.0}) {
      const Scene scene = network_cloud(depth, albedo, 0);
      const Settled end(scene, false, 0, 3000, 1);
      const std::vector<double> theirs = published(*end.backend, end.ran, 4000);
      fmt::print("depth {:3}, albedo {:4}: published {:>4} {:>4} {:>5}", depth, albedo, rounds_to(theirs, 0.1),
                 rounds_to(theirs, 0.01), rounds_to(theirs, 0.001));
      for (const bool gradients : {false, true}) {
        const Settled some(scene, gradients, 1e-3F, 1000, runs);
        fmt::print("; {} {:>4} rounds, {:7.4f} %, {:6.2f} ms", gradients ? "gradients" : "orders",
                   some.ran.steps[2].residuals.size(), 100 * some.off(end), some.milliseconds);
      }
      fmt::print("\n");
      std::fflush(stdout);
    }
  }
}

void curve() {
  constexpr double depth = 10, albedo = 0.99;
  fmt::print(
      "\nConvergence by rounds, depth {}, albedo {}, 1024 particles and 128 directions: what the last round changed as "
      "published;\n"
      "for orders of scattering and conjugate gradients what an order changes of all sources, what they are off and what is "
      "told\n"
      "to be left out, beside what they are; milliseconds of one thread of the whole step, the least of {} runs\n"
      "{:>5} {:>9} | {:>8} {:>8} {:>8} {:>6} | {:>8} {:>8} {:>8} {:>6}\n",
      depth, albedo, runs, "round", "published", "change", "off", "told", "ms", "change", "off", "told", "ms");
  const Scene scene = network_cloud(depth, albedo, 0);
  const Settled end(scene, false, 0, 3000, 1);
  const std::vector<double> theirs = published(*end.backend, end.ran, 100);
  for (const int rounds : {1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 16, 24, 32, 48, 64}) {
    const auto k = static_cast<std::size_t>(rounds) - 1;
    fmt::print("{:>5} {:>9.1e}", rounds, k == 0 ? 1.0 : 1 - theirs[k - 1] / theirs[k]);
    for (const bool gradients : {false, true}) {
      const Settled some(scene, gradients, 0, rounds, runs);
      const StepStats& stats = some.ran.steps[2];
      fmt::print(" | {:>8.1e} {:>8.1e} {:>8.1e} {:>6.2f}", static_cast<double>(stats.residuals.back()), some.off(end),
                 static_cast<double>(stats.left_out), some.milliseconds);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
}

}  // namespace

}  // namespace airlight

int main(int argc, char** argv) {
  const std::string part = argc > 1 ? argv[1] : "";
  if (argc > 2 || (!part.empty() && part != "costs" && part != "rounds" && part != "curve")) {
    fmt::print(stderr, "airlight-network-rounds [costs|rounds|curve]\n");
    return 2;
  }
  if (part.empty() || part == "costs") airlight::costs();
  if (part.empty() || part == "rounds") airlight::convergence();
  if (part.empty() || part == "curve") airlight::curve();
  return 0;
}
