#include "bench/pareto/measure.h"

#include <algorithm>
#include <chrono>
#include <map>

#include "app/airlight.h"

namespace airlight {

namespace {

using Clock = std::chrono::steady_clock;

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Frames of one scene; each differs a little from the one before, so that nothing of it is held already.
class Frames {
 public:
  Frames(const Scene& scene, const MeasureOptions& options) : scene_(scene), options_(options) {}

  // Empty if the backend cannot start.
  std::string start(const std::string& backend, std::string& why_not) {
    try {
      const auto made = renderers_.try_emplace(backend, Renderer({.backend = backend, .threads = options_.threads}));
      return made.first->second.describe();
    } catch (const MachineError& error) {
      why_not = error.what();
      return {};
    }
  }

  HostImage exact(const Configuration& c, Extent extent, Progress& progress) {
    return renderers_.at(c.backend).render(scene_, settings(c, extent), progress).image("beauty");
  }

  double milliseconds(const Configuration& c, Extent extent, Progress& progress) {
    Scene changed = scene_;
    const double factor = 1 + 1e-6 * static_cast<double>(++count_ % 1000 + 1);
    for (LightSource& l : changed.lights) l.power *= factor;
    changed.medium.ambient *= factor;
    changed.medium.emission *= factor;
    changed.background *= factor;
    const Clock::time_point start = Clock::now();
    renderers_.at(c.backend).render(changed, settings(c, extent), progress);
    return 1e3 * std::chrono::duration<double>(Clock::now() - start).count();
  }

 private:
  static RenderSettings settings(const Configuration& c, Extent extent) {
    RenderSettings s;
    s.technique = c.technique;
    s.knobs = c.knobs;
    s.resolution = extent;
    return s;
  }

  const Scene& scene_;
  const MeasureOptions& options_;
  std::map<std::string, Renderer> renderers_;
  std::uint64_t count_ = 0;
};

std::vector<Configuration> configurations(const Scene& scene, const MeasureOptions& options,
                                          const std::vector<std::string>& backends, std::vector<std::string>& left_out) {
  std::vector<Configuration> all;
  for (const Technique& t : techniques()) {
    const auto& asked = options.techniques;
    if (!t.plan || (!asked.empty() && std::find(asked.begin(), asked.end(), t.name) == asked.end())) continue;
    if (const auto why = t.refuses(scene)) {
      left_out.push_back(std::string(t.name) + ": " + *why);
      continue;
    }
    for (const Settings& settings : different_settings(t, scene, options.extent)) {
      for (const std::string& backend : backends) all.push_back({std::string(t.name), backend, settings});
    }
  }
  return all;
}

}  // namespace

Measurement measure(const Scene& scene, const Truth& truth, const MeasureOptions& options, Progress& progress) {
  const Clock::time_point start = Clock::now();
  Measurement m;
  Frames frames(scene, options);
  std::vector<std::string> backends;
  for (const std::string& backend : options.backends) {
    std::string why_not;
    const std::string device = frames.start(backend, why_not);
    if (device.empty()) {
      m.left_out.push_back(backend + ": " + why_not);
    } else {
      backends.push_back(backend);
      m.devices.push_back(device);
    }
  }
  const std::vector<Configuration> all = configurations(scene, options, backends, m.left_out);

  // Every configuration at the size of the truth: its error, and what it costs beside the others.
  for (const Configuration& c : all) {
    progress.report("errors", static_cast<double>(m.points.size()) / static_cast<double>(all.size()));
    Point p{c, relative_error(frames.exact(c, options.truth_extent, progress), truth)};
    std::vector<double> times;
    for (int i = 0; i < 3; ++i) {
      times.push_back(frames.milliseconds(c, options.truth_extent, progress));
      if (times[0] > 200) break;
    }
    p.small_ms = median(times);
    m.points.push_back(p);
  }

  // Those near a front at full size, one frame of each in turn: what disturbs the machine hits all alike. The frame before each
  // one makes the tables of its configuration.
  const std::vector<bool> worth = near_front(m.points, options.everything ? 0 : 0.6);
  const double growth = static_cast<double>(options.extent.width) * options.extent.height /
                        (static_cast<double>(options.truth_extent.width) * options.truth_extent.height);
  std::vector<std::vector<double>> times(m.points.size());
  for (int round = 0; round < options.repeats; ++round) {
    if (round > 0 && std::chrono::duration<double>(Clock::now() - start).count() > options.limit) break;
    for (std::size_t i = 0; i < m.points.size(); ++i) {
      progress.report("times", (round + static_cast<double>(i) / static_cast<double>(m.points.size())) / options.repeats);
      const bool slow = m.points[i].small_ms * growth > 1e3 * options.longest;
      if (!worth[i] || (slow && round > 0)) continue;
      const Configuration& c = m.points[i].configuration;
      if (!slow) frames.milliseconds(c, options.extent, progress);
      times[i].push_back(frames.milliseconds(c, options.extent, progress));
    }
  }
  for (std::size_t i = 0; i < m.points.size(); ++i) m.points[i].ms = median(times[i]);
  mark_fronts(m.points);
  return m;
}

void mark_fronts(std::vector<Point>& points) {
  for (Point& p : points) {
    p.on_front = p.ms > 0 && std::none_of(points.begin(), points.end(), [&](const Point& other) {
                   return other.configuration.backend == p.configuration.backend && other.ms > 0 && other.ms <= p.ms &&
                          other.error.everywhere <= p.error.everywhere &&
                          (other.ms < p.ms || other.error.everywhere < p.error.everywhere);
                 });
  }
}

std::vector<bool> near_front(const std::vector<Point>& points, double part) {
  std::vector<bool> near;
  for (const Point& p : points) {
    near.push_back(std::none_of(points.begin(), points.end(), [&](const Point& other) {
      return other.configuration.backend == p.configuration.backend && other.small_ms < part * p.small_ms &&
             other.error.everywhere <= p.error.everywhere;
    }));
  }
  return near;
}

const Point* cheapest_within_error(const std::vector<Point>& points, double error) {
  const Point* best = nullptr;
  for (const Point& p : points) {
    if (p.ms > 0 && p.error.everywhere <= error && (!best || p.ms < best->ms)) best = &p;
  }
  return best;
}

const Point* best_within_time(const std::vector<Point>& points, double ms) {
  const Point* best = nullptr;
  for (const Point& p : points) {
    if (p.ms > 0 && p.ms <= ms && (!best || p.error.everywhere < best->error.everywhere)) best = &p;
  }
  return best;
}

}  // namespace airlight
