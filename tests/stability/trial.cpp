#include "tests/stability/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include "common/reference/pixel.h"
#include "common/relative_rmse.h"
#include "common/techniques/technique.h"
#include "tests/parity/compare.h"
#include "tests/stability/draw.h"
#include "tests/stability/truth.h"
#include "tests/tolerances.h"

namespace airlight {

namespace {

void check_numbers(const Frame& frame, Trial& trial) {
  for (const NamedImage& named : frame.images) {
    std::size_t bad = 0, negative = 0;
    float first = 0, least = 0;
    for (const float v : named.image.values) {
      if (!std::isfinite(v) && bad++ == 0) first = v;
      if (v < 0 && named.name != "normal") ++negative, least = std::min(least, v);
    }
    if (bad > 0) trial.failures.push_back(fmt::format("{}: {} numbers are not finite, the first {}", named.name, bad, first));
    if (negative > 0) trial.failures.push_back(fmt::format("{}: {} numbers below 0, the least {}", named.name, negative, least));
  }
}

// beauty = surface + airlight in every bit; surface = its parts.
void check_sums(const Frame& frame, Trial& trial) {
  const auto values = [&](const char* name) -> const std::vector<float>& { return frame.image(name).values; };
  const std::vector<float>&beauty = values("beauty"), &surface = values("surface"), &airlight = values("airlight"),
        &depth = values("depth");
  std::size_t apart = 0, parts_apart = 0;
  float largest = 0;
  for (const float v : surface) largest = std::max(largest, v);
  for (std::size_t i = 0; i < beauty.size(); ++i) {
    apart += beauty[i] == surface[i] + airlight[i] ? 0 : 1;
    if (!(depth[i / 3] < 1e30F)) continue;  // background
    float sum = values("surface.direct")[i] + values("surface.indirect")[i] + values("surface.ambient")[i];
    for (const NamedImage& named : frame.images) sum += named.name == "surface.environment" ? named.image.values[i] : 0;
    parts_apart +=
        std::fabs(static_cast<double>(sum - surface[i])) <= tolerance("stress_sum") * static_cast<double>(largest) ? 0 : 1;
  }
  if (apart > 0) trial.failures.push_back(fmt::format("beauty: {} numbers are not surface + airlight", apart));
  if (parts_apart > 0) trial.failures.push_back(fmt::format("surface: {} numbers are not the sum of its parts", parts_apart));
}

void compare_bits(const Frame& a, const Frame& b, Trial& trial) {
  for (std::size_t k = 0; k < a.images.size(); ++k) {
    const std::vector<float>&x = a.images[k].image.values, &y = b.images[k].image.values;
    std::size_t apart = 0, first = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (std::memcmp(&x[i], &y[i], sizeof(float)) != 0 && apart++ == 0) first = i;
    }
    if (apart > 0)
      trial.failures.push_back(fmt::format("{}: {} numbers of {} in {}, not in {}, the first {:.9g} and {:.9g}", a.images[k].name,
                                           apart, x.size(), a.device, b.device, x[first], y[first]));
  }
}

}  // namespace

Trials::Trials() : scalar_({.backend = "cpu", .simd = "scalar", .threads = 1}), vector_({.backend = "cpu", .threads = 3}) {}

// Pixels at edges left out. Beside the larger of the two and a hundredth of the picture's mean: so dark ones count, too.
void Trials::compare_gl(const Scene& scene, const RenderSettings& settings, const Frame& cpu, Trial& trial) {
  if (!gl_) gl_.emplace(RendererOptions{.backend = "gl", .gl_context = "osmesa"});
  const Frame gl = gl_->render(scene, settings);
  check_numbers(gl, trial);
  const HostImage& depth = cpu.image("depth");
  const std::vector<bool> on_cpu = edges_of(depth.extent, depth.values), on_gl = edges_of(depth.extent, gl.image("depth").values);
  for (const char* name : {"transmittance", "surface", "airlight"}) {
    const HostImage &a = cpu.image(name), &b = gl.image(name);
    double sum = 0;
    for (const float v : a.values) sum += static_cast<double>(v);
    const double mean = sum / static_cast<double>(a.values.size());
    std::size_t beyond = 0, worst_at = 0;
    double worst = 0;
    const auto channels = static_cast<std::size_t>(a.channels);
    for (std::size_t i = 0; i < a.values.size(); ++i) {
      const std::size_t pixel = i / channels;
      if (on_cpu[pixel] || on_gl[pixel]) continue;
      const double x = static_cast<double>(a.values[i]), y = static_cast<double>(b.values[i]);
      const double apart = std::fabs(x - y) / std::max({x, y, 0.01 * mean, tolerance("stress_dark")});
      if (apart > tolerance("stress_gl")) ++beyond;
      if (apart > worst) worst = apart, worst_at = i;
    }
    trial.gl_apart = std::max(trial.gl_apart, worst);
    const auto few = static_cast<std::size_t>(tolerance("stress_gl_share") * static_cast<double>(a.values.size()));
    if (beyond > few)
      trial.failures.push_back(
          fmt::format("{}: {} of {} numbers apart on CPU and GL, worst {:.3g} at pixel {}: {:.6g} and {:.6g}", name, beyond,
                      a.values.size(), worst, worst_at / channels, a.values[worst_at], b.values[worst_at]));
  }
}

Trial Trials::run(const Scene& scene, const Asked& asked, std::uint32_t number, const TrialOptions& options) {
  Trial trial;
  RenderSettings settings;
  settings.technique = asked.technique;
  settings.knobs = asked.settings;
  settings.images = asked.images;
  try {
    const Frame vector = vector_.render(scene, settings);
    check_numbers(vector, trial);
    check_sums(vector, trial);
    compare_bits(vector, scalar_.render(scene, settings), trial);
    if (options.gl) compare_gl(scene, settings, vector, trial);
    if (options.truth_pixels > 0 && trial.failures.empty()) hold_to_truth(scene, asked, number, options, vector, trial);
  } catch (const InputError& e) {
    trial.refused = e.what();
  } catch (const std::exception& e) {
    trial.failures.push_back(fmt::format("an exception: {}", e.what()));
  }
  return trial;
}

}  // namespace airlight
