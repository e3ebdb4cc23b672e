#include "bench/pareto/frames.h"

#include <chrono>

namespace airlight {

namespace {

RenderSettings settings_of(const Configuration& c, Extent extent) {
  RenderSettings s;
  s.technique = c.technique;
  s.knobs = c.all_knobs();
  s.resolution = extent;
  return s;
}

}  // namespace

Frames::Frames(const Scene& scene, const std::vector<std::string>& backends, const std::string& simd, int threads)
    : scene_(scene) {
  for (const std::string& backend : backends) {
    try {
      const auto made =
          renderers_.try_emplace(backend, Renderer({.backend = backend, .simd = simd, .threads = threads, .keep = 0}));
      devices_[backend] = made.first->second.describe();
    } catch (const MachineError& error) {
      not_started_.push_back(backend + ": " + error.what());
    }
  }
}

HostImage Frames::exact(const Configuration& c, Extent extent, Progress& progress) {
  return renderers_.at(c.backend).render(scene_, settings_of(c, extent), progress).image("beauty");
}

double Frames::milliseconds(const Configuration& c, Extent extent, Progress& progress) {
  Scene changed = scene_;
  count_ = count_ % 1000 + 1;
  const double factor = 1 + 1e-6 * count_;
  for (LightSource& l : changed.lights) l.power *= factor;
  changed.medium.ambient *= factor;
  changed.medium.emission *= factor;
  for (Gaussian& g : changed.medium.gaussians) g.emission *= factor;
  changed.background *= factor;
  const RenderSettings settings = settings_of(c, extent);
  const auto start = std::chrono::steady_clock::now();
  renderers_.at(c.backend).render(changed, settings, progress);
  return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace airlight
