// airlight-sampled SCENE...: low-resolution airlight beside full, as a table for docs/RESULTS.md: time and what it leaves. Of
// each technique that has the knob, medians of frames at all resolutions in turn, so that the machine's noise hits all alike.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "app/airlight.h"
#include "common/relative_rmse.h"
#include "common/techniques/technique.h"

namespace airlight {

namespace {

constexpr const char* resolutions[] = {"full", "half", "quarter"};
constexpr int frames = 5;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double error(const HostImage& image, const HostImage& truth) {
  RelativeRmse e;
  for (std::size_t i = 0; i < truth.values.size(); ++i)
    e.add(static_cast<double>(image.values[i]), static_cast<double>(truth.values[i]));
  return e.value();
}

struct Measured {
  std::vector<double> frame, steps;  // [ms]; the steps' of all threads together
  double airlight = 0, beauty = 0;   // relative RMSE
};

void measure(const Scene& loaded, const std::string& name, const std::string& technique) {
  Measured all[3];
  Frame full;
  std::vector<Renderer> renderers;
  for (int k = 0; k < 3; ++k) renderers.emplace_back(RendererOptions{.keep = 0});
  for (int i = -1; i < frames; ++i) {
    Scene scene = loaded;
    for (LightSource& light : scene.lights) light.power *= 1 + 1e-3 * i;  // all but surfaces and volumes is made again
    for (std::size_t k = 0; k < 3; ++k) {
      RenderSettings settings;
      settings.technique = technique;
      settings.knobs.emplace_back("airlight_resolution", resolutions[k]);
      settings.images = {"beauty", "airlight"};
      const auto start = std::chrono::steady_clock::now();
      Frame frame = renderers[k].render(scene, settings);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (i < 0) {
        if (k == 0) full = std::move(frame);
        if (k > 0) all[k].airlight = error(frame.image("airlight"), full.image("airlight"));
        if (k > 0) all[k].beauty = error(frame.image("beauty"), full.image("beauty"));
        continue;
      }
      double steps = 0;
      for (const StepStats& s : frame.stats.steps) {
        for (const char* one : {"subsample", "gaussian_airlight", "ray_march", "depth_aware_upsample", "fill_airlight"})
          steps += s.name == one ? s.seconds : 0;
      }
      all[k].frame.push_back(1e3 * seconds);
      all[k].steps.push_back(1e3 * steps);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Measured& m = all[k];
    fmt::print("| {} | {} | {} | {:.1f} | {:.1f} | {:.2f} | {} | {} |\n", name, technique, resolutions[k], median(m.frame),
               median(m.steps), median(m.steps) / median(all[0].steps), k == 0 ? "" : fmt::format("{:.2f}", 100 * m.airlight),
               k == 0 ? "" : fmt::format("{:.2f}", 100 * m.beauty));
  }
}

int run(int count, char** arguments) {
  if (count < 2) throw InputError("usage: airlight-sampled SCENE...");
  fmt::print(
      "| scene | technique | resolution | frame [ms] | airlight, of all threads [ms] | of full | airlight's error [%] | beauty's "
      "|\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  for (int i = 1; i < count; ++i) {
    const Scene scene = load_scene(arguments[i]);
    for (const Technique& t : techniques()) {
      const bool has = std::any_of(t.knobs.begin(), t.knobs.end(), [](const Knob& k) { return k.name == "airlight_resolution"; });
      if (!has || t.multiple_scattering || t.refuses(scene)) continue;
      measure(scene, std::filesystem::path(arguments[i]).stem().string(), std::string(t.name));
    }
  }
  return 0;
}

}  // namespace

}  // namespace airlight

int main(int count, char** arguments) {
  try {
    return airlight::run(count, arguments);
  } catch (const airlight::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
