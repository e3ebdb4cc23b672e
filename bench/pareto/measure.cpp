#include "bench/pareto/measure.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/pareto/frames.h"

namespace airlight {

namespace {

constexpr double slack = 1.5;  // of near_front()
constexpr int visit = 2;       // timed frames after each one that makes the tables of a configuration

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

std::string joined_lines(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += (all.empty() ? "" : "; ") + line;
  return all;
}

double pixels(Extent e) { return static_cast<double>(e.width) * e.height; }

class Run {
 public:
  Run(Frames& frames, const MeasureOptions& options, Deadline& deadline, Measurement& m)
      : frames_(frames), options_(options), deadline_(deadline), m_(m) {}

  void errors(const std::vector<Configuration>& all, const Truth& truth) {
    for (const Configuration& c : all) {
      deadline_.report("errors", static_cast<double>(m_.points.size()) / static_cast<double>(all.size()));
      Point p;
      p.configuration = c;
      p.error = relative_error(frames_.exact(c, options_.truth_extent, deadline_), truth);
      std::vector<double> times;
      do {
        times.push_back(frames_.milliseconds(c, options_.truth_extent, deadline_));
      } while (times.size() < 3 && times[0] < 100);
      p.small_ms = median(times);
      m_.points.push_back(p);
    }
  }

  void times() {
    times_.resize(m_.points.size());
    const std::vector<bool> near = options_.everything ? std::vector<bool>(m_.points.size(), true) : near_front(m_.points, slack);
    for (int round = 0; round * visit < options_.repeats; ++round) {
      for (std::size_t i = 0; i < m_.points.size(); ++i) {
        deadline_.report("times",
                         (round + static_cast<double>(i) / static_cast<double>(m_.points.size())) * visit / options_.repeats);
        if (near[i]) time(i);
      }
    }
  }

  // The medians of what there is, also after an interruption.
  void finish() {
    for (std::size_t i = 0; i < times_.size(); ++i) m_.points[i].ms = median(times_[i]);
    mark_fronts(m_.points);
  }

 private:
  // One visit: a frame that is not counted makes what the configuration before it has replaced, then the counted ones.
  void time(std::size_t i) {
    const Configuration& c = m_.points[i].configuration;
    const double longest = 1e3 * options_.longest;
    std::vector<double>& times = times_[i];
    if (!times.empty() && times[0] > longest) return;
    if (m_.points[i].small_ms * pixels(options_.extent) / pixels(options_.truth_extent) > longest) {
      frames_.milliseconds(c, options_.truth_extent, deadline_);
      times.push_back(frames_.milliseconds(c, options_.extent, deadline_));
      if (times[0] > longest) return;
    } else {
      frames_.milliseconds(c, options_.extent, deadline_);
    }
    for (int k = 0; k < visit && static_cast<int>(times.size()) < options_.repeats; ++k) {
      times.push_back(frames_.milliseconds(c, options_.extent, deadline_));
      if (times[0] > longest) return;
    }
  }

  Frames& frames_;
  const MeasureOptions& options_;
  Deadline& deadline_;
  Measurement& m_;
  std::vector<std::vector<double>> times_;
};

}  // namespace

Measurement measure(const Scene& scene, const Truth& truth, const MeasureOptions& options, Deadline& deadline) {
  Measurement m;
  Frames frames(scene, options.backends, options.simd, options.threads);
  m.devices = frames.devices();
  m.left_out = frames.not_started();
  std::vector<std::string> backends;
  for (const std::string& b : options.backends) {
    if (m.devices.contains(b) && std::find(backends.begin(), backends.end(), b) == backends.end()) backends.push_back(b);
  }
  if (backends.empty()) throw MachineError("no backend starts: " + joined_lines(m.left_out));
  std::vector<std::string> refused;
  const std::vector<Configuration> all = configurations(scene, options.extent, options.techniques, backends, refused);
  if (all.empty()) throw InputError("no technique renders it: " + joined_lines(refused));
  m.left_out.insert(m.left_out.end(), refused.begin(), refused.end());

  Run run(frames, options, deadline, m);
  try {
    run.errors(all, truth);
    run.times();
  } catch (const Interrupted&) {
    if (!deadline.passed()) throw;
    m.left_out.push_back(m.points.size() < all.size()
                             ? fmt::format("{} of {} configurations: the time is over", all.size() - m.points.size(), all.size())
                             : std::string("rounds of timed frames: the time is over"));
  }
  run.finish();
  return m;
}

}  // namespace airlight
