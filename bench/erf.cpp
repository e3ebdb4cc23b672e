// airlight-erf: time and error of error functions, ours beside those of libraries, and of optical depths of Gaussians along rays,
// on one core and out of its nearest cache; what the core's ports would allow beside it.
#include "bench/erf.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "bench/erf_counts.h"
#include "cpu/targets.h"

namespace airlight {

namespace {

// Numbers in from..to, always the same.
std::vector<float> numbers(std::size_t n, std::uint32_t stream, double from, double to) {
  std::vector<float> values(n);
  std::uint32_t state = 2654435761U * (stream + 1);
  for (float& v : values) {
    state ^= state << 13, state ^= state >> 17, state ^= state << 5;
    v = static_cast<float>(from + (to - from) * state * 0x1p-32);
  }
  return values;
}

double erf_error(const ErfFunction& f) {
  constexpr std::size_t n = 800000;
  std::vector<float> x(n), y(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = static_cast<float>((static_cast<double>(i) - n / 2.0) * 1.25e-5);
  f.run(x.data(), y.data(), n);
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double error = std::fabs(static_cast<double>(y[i]) - std::erf(static_cast<double>(x[i])));
    worst = error > worst || std::isnan(error) ? error : worst;
  }
  return worst;
}

// Rays from the origin toward 4 m x 4 m at z = 5, and Gaussians around there.
struct Lines {
  static constexpr std::size_t ray_count = 1024, gaussian_count = 32;
  std::vector<float> x = numbers(ray_count, 1, -2, 2), y = numbers(ray_count, 2, -2, 2), z = std::vector<float>(ray_count, 5.0F);
  std::vector<float> length = numbers(ray_count, 3, 3, 9);
  std::vector<LineGaussian> gaussians;

  Lines() {
    for (std::size_t i = 0; i < ray_count; ++i) {
      const float scale = 1 / std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
      x[i] *= scale, y[i] *= scale, z[i] *= scale;
    }
    const std::vector<float> u = numbers(5 * gaussian_count, 4, 0, 1);
    for (std::size_t i = 0; i < gaussian_count; ++i) {
      const float* p = &u[5 * i];
      gaussians.push_back({4 * p[0] - 2, 4 * p[1] - 2, 3 + 4 * p[2], 1 / (0.4F + p[3]), 0.1F + p[4]});
    }
  }
  LineRays rays() const { return {x.data(), y.data(), z.data(), length.data(), ray_count}; }

  // The largest, beside the largest optical depth.
  double error(const LineIntegral& f) const {
    std::vector<float> found(ray_count);
    f.run(rays(), gaussians, found.data());
    double worst = 0, most = 0;
    for (std::size_t i = 0; i < ray_count; ++i) {
      double truth = 0;
      for (const LineGaussian& g : gaussians) {
        const double dx = x[i], dy = y[i], dz = z[i], a = g.inverse, foot = dx * g.x + dy * g.y + dz * g.z;
        const double ex = g.x - foot * dx, ey = g.y - foot * dy, ez = g.z - foot * dz,
                     end = static_cast<double>(length[i]) - foot;
        truth += 0.5 * g.whole * std::exp(-a * a * (ex * ex + ey * ey + ez * ez)) * (std::erf(a * end) + std::erf(a * foot));
      }
      const double error = std::fabs(static_cast<double>(found[i]) - truth);
      worst = error > worst || std::isnan(error) ? error : worst;
      most = std::max(most, truth);
    }
    return worst / most;
  }
};

void count(benchmark::State& state, const OperationCounts& c) {
  state.counters["multiplications"] = c.multiplications;
  state.counters["others"] = c.others;
  state.counters["roots"] = c.roots;
}

void run_erf(benchmark::State& state, const ErfFunction& f) {
  constexpr std::size_t n = 2048;
  const std::vector<float> x = numbers(n, 0, -4, 4);
  std::vector<float> y(n);
  for (auto _ : state) {
    f.run(x.data(), y.data(), n);
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
  state.counters["error"] = erf_error(f);
  if (f.name == "ours") count(state, count_erf(0));
  if (f.name == "ours, as printed") count(state, count_erf(1));
}

void run_line(benchmark::State& state, const LineIntegral& f, const Lines& lines) {
  std::vector<float> depth(Lines::ray_count);
  for (auto _ : state) {
    f.run(lines.rays(), lines.gaussians, depth.data());
    benchmark::DoNotOptimize(depth.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(Lines::ray_count * Lines::gaussian_count));
  state.counters["error"] = lines.error(f);
  if (f.name == "ours") count(state, count_line(0));
  if (f.name == "ours, erf as printed") count(state, count_line(1));
}

void run_limit(benchmark::State& state, const PortLimit& limit) {
  float keep[48];
  std::size_t results = 0;
  for (auto _ : state) {
    std::fill(std::begin(keep), std::end(keep), 0.999F);
    results += limit.run(keep);
    benchmark::DoNotOptimize(keep);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(results));
}

void glibc_erf(const float* x, float* y, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) y[i] = std::erf(x[i]);
}

}  // namespace

}  // namespace airlight

int main(int argc, char** argv) {
  using namespace airlight;
  ErfCandidates all;
  all.erf.push_back({"glibc", "scalar", glibc_erf});
  [[maybe_unused]] const auto has = [](Simd simd) {
    const std::vector<Simd> there = available_simd();
    return std::find(there.begin(), there.end(), simd) != there.end();
  };
#ifdef AIRLIGHT_OTHERS
  if (has(Simd::avx2)) add_plain_avx2(all), add_others_avx2(all);
  if (has(Simd::avx512)) add_plain_avx512(all), add_others_avx512(all);
#endif
  add_ours(all);
  const Lines lines;
  for (const PortLimit& l : all.limits) {
    benchmark::RegisterBenchmark(("limit/" + l.name + "/" + l.target).c_str(), [&l](benchmark::State& s) { run_limit(s, l); });
  }
  for (const ErfFunction& f : all.erf) {
    benchmark::RegisterBenchmark(("erf/" + f.name + "/" + f.target).c_str(), [&f](benchmark::State& s) { run_erf(s, f); });
  }
  for (const LineIntegral& f : all.lines) {
    benchmark::RegisterBenchmark(("line/" + f.name + "/" + f.target).c_str(),
                                 [&f, &lines](benchmark::State& s) { run_line(s, f, lines); });
  }
  std::printf("# not here: %s\n", AIRLIGHT_ERF_MISSING);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
