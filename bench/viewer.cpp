// What the viewer takes for a picture while its user drags something: the table of docs/viewer.md.
//   airlight-viewer SCENE...
// CPU time of the process over two threads, tone mapping with it, the least of five pictures [ms], so that other work counts
// little; and wall time, which is the same where nothing else runs.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <ctime>
#include <filesystem>
#include <functional>
#include <mutex>

#include "app/view_camera.h"
#include "app/view_session.h"
#include "app/view_worker.h"

namespace airlight {

namespace {

constexpr int threads = 2, pictures = 5;
constexpr Extent extent{800, 600};

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Asks a worker and waits for its picture.
class Pictures {
 public:
  Pictures() : worker_({.backend = "cpu", .threads = threads}, false, [this] { ready(); }) {}

  ViewPicture of(const Scene& scene) {
    ViewJob job;
    job.number = ++number_;
    job.scene = scene;
    job.settings.resolution = extent;
    worker_.ask(std::move(job));
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return ready_; });
    ready_ = false;
    return *worker_.take();
  }

 private:
  void ready() {
    {
      const std::lock_guard lock(mutex_);
      ready_ = true;
    }
    done_.notify_one();
  }

  std::mutex mutex_;
  std::condition_variable done_;
  bool ready_ = false;
  std::uint64_t number_ = 0;
  ViewWorker worker_;  // last: it uses all of the above
};

// "62 (64)", or "-" where the scene takes no such edit.
std::string measured(ViewSession& session, Pictures& from, const std::function<void(int)>& edit) {
  double cpu = 0, wall = 0;
  for (int i = 0; i < pictures; ++i) {
    try {
      edit(i);
    } catch (const InputError&) {
      return "-";
    }
    const double began = cpu_seconds();
    const ViewPicture p = from.of(session.scene());
    if (!p.error.empty()) return "refused";
    const double c = (cpu_seconds() - began) / threads;
    cpu = i == 0 ? c : std::min(cpu, c), wall = i == 0 ? p.seconds : std::min(wall, p.seconds);
  }
  return fmt::format("{:.0f} ({:.0f})", 1e3 * cpu, 1e3 * wall);
}

void measure(const std::string& path) {
  NoProgress none;
  ViewSession session(path, "", "", none);
  Pictures from;
  from.of(session.scene());  // the first makes what all others keep
  const std::string camera = measured(session, from, [&](int) { session.look(orbited(session.scene().camera, {0.02, 0.01})); });
  const std::string light = measured(session, from, [&](int i) {
    if (session.scene().lights.empty()) throw InputError("no light");
    const LightSource& l = session.scene().lights.front();
    LightEdit e{l.name.empty() ? "0" : l.name, {}, {}, {}};
    const glm::dvec3 step(0, 0.02 * (i + 1), 0);
    if (l.type == LightType::point) e.position = l.position + step;
    if (l.type == LightType::directional) e.direction = l.direction + step;
    session.apply(e);
  });
  const std::string paint = measured(session, from, [&](int i) {
    PaintEdit e;
    e.stroke.points = {session.scene().camera.look_at};
    e.puff.radius = 0.2, e.puff.extinction = 1, e.seed = i;
    session.apply(e);
  });
  fmt::print("| {} | {} | {} | {} |\n", std::filesystem::path(path).stem().string(), camera, light, paint);
}

}  // namespace

}  // namespace airlight

int main(int argc, char** argv) {
  try {
    fmt::print("| scene | camera moves | a light moves | a Gaussian is painted |\n|---|---|---|---|\n");
    for (int i = 1; i < argc; ++i) airlight::measure(argv[i]);
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  }
}
