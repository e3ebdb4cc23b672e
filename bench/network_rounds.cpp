// airlight-network-rounds: what illumination networks cost by particles and directions, and how many rounds their light takes to
// settle, beside the iteration as it is published, which carries light over one link a round.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
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

// The same equations as the rounds of NetworkIteration, isotropic, of the first channel, in double: what particles take is
// symmetric in those that send and those that take, so that conjugate gradients solve them, of which an iteration takes a round's
// sweeps. Gives how much all sources are off after each, beside what rounds made of them.
std::vector<double> conjugate_gradients(CpuBackend& backend, const Ran& ran, int rounds) {
  const NetworkShape shape = ran.network.network.shape();
  const std::vector<float> links = download(backend, ran.network.network.links),
                           first = download(backend, ran.network.light.first),
                           sources = download(backend, ran.network.iteration.sources);
  const auto* lines = reinterpret_cast<const std::int32_t*>(ran.all.buffers[1].second.data());
  const std::size_t n = shape.particles;
  using Values = std::vector<double>;
  Values weight(n, 0.0);
  const auto sweep = [&](const Values* sent, Values& taken) {
    std::fill(taken.begin(), taken.end(), 0.0);
    for (std::size_t l = 0; l < shape.lines; ++l) {
      const double area = 0x1p-40 * lines[l * line_fields + line_pixel] * lines[l * line_fields + line_pixel + 1];
      const float* begin = links.data() + l * (shape.slots + 1);
      for (std::size_t c = 0; c < shape.slots; ++c) {
        const auto at = static_cast<std::size_t>(begin[c]) + c, count = static_cast<std::size_t>(begin[c + 1]) + c - at;
        const auto of = [&](int plane, std::size_t k) { return static_cast<double>(links[shape.record(l, plane) + at + k]); };
        double beam = 0;
        for (std::size_t step = 0; count > 0 && step < 2 * (count + 1); ++step) {
          if (step % (count + 1) == 0) beam = 0;
          const std::size_t k = step <= count ? step : 2 * count + 1 - step;
          const auto a = static_cast<std::size_t>(of(link_particle, k == 0 ? 0 : k - 1)),
                     b = static_cast<std::size_t>(of(link_particle, k == count ? count - 1 : k));
          double got = of(link_depth, k);  // the weights, without anything sent
          if (sent) {
            const double mean = 0.5 * ((*sent)[a] + (*sent)[b]);
            got = of(link_given, k) * beam + of(link_kept, k) * mean;
            beam += of(link_given, k) * mean - of(link_lost, k) * beam;
          }
          taken[a] += 0.5 * area * got, taken[b] += 0.5 * area * got;
        }
      }
    }
  };
  sweep(nullptr, weight);
  const auto albedo = static_cast<double>(ran.network.network.gaussians[0].albedo.x);
  Values x(n), residual(n), way(n), taken(n);
  // (weight / albedo - taken) x = weight / albedo first, from x = first on, preconditioned by weight / albedo.
  for (std::size_t v = 0; v < n; ++v) x[v] = static_cast<double>(first[4 * v]), weight[v] /= albedo;
  sweep(&x, residual);
  const auto scaled = [&] {
    double sum = 0;
    for (std::size_t v = 0; v < n; ++v) sum += weight[v] > 0 ? residual[v] * residual[v] / weight[v] : 0;
    return sum;
  };
  double size = scaled(), before = 0;
  std::vector<Values> all;
  for (int round = 0; round < rounds && size > 0; ++round) {
    for (std::size_t v = 0; v < n; ++v)
      way[v] = (weight[v] > 0 ? residual[v] / weight[v] : 0) + (before > 0 ? size / before : 0) * way[v];
    sweep(&way, taken);
    double along = 0;
    for (std::size_t v = 0; v < n; ++v) along += way[v] * (weight[v] * way[v] - taken[v]);
    if (!(along > 0)) break;
    for (std::size_t v = 0; v < n; ++v)
      x[v] += size / along * way[v], residual[v] -= size / along * (weight[v] * way[v] - taken[v]);
    before = size, size = scaled();
    all.push_back(x);
  }
  std::vector<double> off;
  for (const Values& one : all) {
    double sum = 0, end = 0;
    for (std::size_t v = 0; v < n; ++v) {
      const auto settled = static_cast<double>(sources[4 * v]);
      sum += std::fabs(one[v] - settled), end += settled;
    }
    off.push_back(sum / end);
  }
  return off;
}

// Rounds until no more than a share of the light is missing of what there is in the end.
int rounds_to(const std::vector<double>& sums, double share) {
  const auto enough = [&](double sum) { return sum >= (1 - share) * sums.back(); };
  return static_cast<int>(std::find_if(sums.begin(), sums.end(), enough) - sums.begin()) + 1;
}

void convergence(CpuBackend& backend) {
  fmt::print(
      "\nRounds until 10 %, 1 % and 0.1 % of the light are missing, 1024 particles and 128 directions, isotropic: a whole order "
      "of\n"
      "scattering a round, and as published; milliseconds of one core for ours to 0.1 %. Conjugate gradients, which take a\n"
      "round's sweeps an iteration and are in this program alone: iterations until all sources together are off by as much\n");
  for (const double depth : {4.0, 10.0, 40.0}) {
    for (const double albedo : {0.9, 0.99, 1.0}) {
      const Scene scene = network_cloud(depth, albedo, 0);
      const Ran ran = run(backend, scene, parts_of(scene, 1024, 128, 0, 6000));
      std::vector<double> ours;
      double sum = 1;
      for (const float change : ran.steps[2].residuals) ours.push_back(sum /= 1 - static_cast<double>(change));
      const std::vector<double> theirs = published(backend, ran, 8000);
      fmt::print("depth {:3}, albedo {:4}: {:>4} {:>4} {:>5}, published {:>4} {:>4} {:>5}", depth, albedo, rounds_to(ours, 0.1),
                 rounds_to(ours, 0.01), rounds_to(ours, 0.001), rounds_to(theirs, 0.1), rounds_to(theirs, 0.01),
                 rounds_to(theirs, 0.001));
      const double a_round = 1e-3 * ran.milliseconds[2] / static_cast<double>(ran.steps[2].residuals.size());
      const std::vector<double> gradients = conjugate_gradients(backend, ran, 200);
      const auto iterations_to = [&](double share) {
        const auto last = std::find_if(gradients.rbegin(), gradients.rend(), [&](double off) { return off > share; });
        return gradients.rend() - last + 1;
      };
      fmt::print("; {:.1f} ms; gradients {:>3} {:>3} {:>3}\n", 1e3 * a_round * rounds_to(ours, 0.001), iterations_to(0.1),
                 iterations_to(0.01), iterations_to(0.001));
    }
  }
}

}  // namespace

}  // namespace airlight

int main(int argc, char** argv) {
  const std::string part = argc > 1 ? argv[1] : "";
  if (argc > 2 || (!part.empty() && part != "costs" && part != "rounds")) {
    fmt::print(stderr, "airlight-network-rounds [costs|rounds]\n");
    return 2;
  }
  if (part != "rounds") airlight::costs();
  airlight::CpuBackend backend(airlight::CpuOptions{});
  if (part != "costs") airlight::convergence(backend);
  return 0;
}
