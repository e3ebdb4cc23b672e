// What the viewer takes for a picture while its user drags something, until the window shows it: the table of docs/viewer.md.
//   airlight-viewer [--gl] SCENE...
// By the CPU; with --gl also by OpenGL whose pictures are read back and by that of the window, a picture of each in turn. CPU
// time of the process over two threads, the least of five pictures [ms], so that other work counts little; and wall time, which
// is the same where nothing else runs. Last, the least wall time but for the steps: planning, reading back, uploading, drawing
// the window.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <ctime>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/view_camera.h"
#include "app/view_session.h"
#include "app/view_window.h"
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

// A renderer whose pictures are shown in the window, from the question to the frame with its answer.
class Way {
 public:
  Way(std::string name, ViewWindow& window, RendererOptions options)
      : name_(std::move(name)), window_(window), worker_(std::move(options), false, [this] { ready(); }) {}

  const std::string& name() const { return name_; }

  struct Shown {
    std::string error;
    double steps = 0;  // [s] of wall time
  };
  Shown show(const Scene& scene) {
    ViewJob job;
    job.number = ++number_;
    job.scene = scene;
    job.settings.resolution = extent;
    worker_.ask(std::move(job));
    {
      std::unique_lock lock(mutex_);
      done_.wait(lock, [this] { return ready_; });
      ready_ = false;
    }
    const ViewPicture p = *worker_.take();
    if (!p.error.empty()) return {p.error};
    if (p.texture) {
      window_.painter().set(0, p.texture);
    } else {
      window_.painter().set(0, p.image);
    }
    window_.begin_frame();
    window_.draw_picture(0, {{0, 0}, {extent.width, extent.height}}, 0);
    window_.end_frame(false);
    return {{}, p.stats.seconds};
  }

 private:
  void ready() {
    {
      const std::lock_guard lock(mutex_);
      ready_ = true;
    }
    done_.notify_one();
  }

  std::string name_;
  ViewWindow& window_;
  std::mutex mutex_;
  std::condition_variable done_;
  bool ready_ = false;
  std::uint64_t number_ = 0;
  ViewWorker worker_;  // last: it uses all of the above
};

struct Times {
  double cpu = 0, wall = 0, rest = 0;
  bool refused = false;
};

// Of each way, which take turns; nothing where the scene takes no such edit.
std::vector<Times> measured(ViewSession& session, std::deque<Way>& ways, const std::function<void(int)>& edit) {
  std::vector<Times> least(ways.size());
  for (int i = 0; i < pictures; ++i) {
    try {
      edit(i);
    } catch (const InputError&) {
      return {};
    }
    for (std::size_t k = 0; k < ways.size(); ++k) {
      Times& t = least[k];
      const double began = cpu_seconds();
      const auto clock = std::chrono::steady_clock::now();
      const Way::Shown shown = ways[k].show(session.scene());
      t.refused = !shown.error.empty();
      const double cpu = (cpu_seconds() - began) / threads;
      const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
      const Times now{cpu, wall, wall - shown.steps, t.refused};
      t = i == 0 ? now : Times{std::min(t.cpu, cpu), std::min(t.wall, wall), std::min(t.rest, now.rest), t.refused};
    }
  }
  return least;
}

void measure(const std::string& path, std::deque<Way>& ways) {
  NoProgress none;
  ViewSession session(path, "", "", none);
  for (Way& way : ways) way.show(session.scene());  // the first makes what all others keep
  std::vector<std::vector<Times>> edits;
  edits.push_back(measured(session, ways, [&](int) { session.look(orbited(session.scene().camera, {0.02, 0.01})); }));
  edits.push_back(measured(session, ways, [&](int i) {
    if (session.scene().lights.empty()) throw InputError("no light");
    const LightSource& l = session.scene().lights.front();
    LightEdit e{l.name.empty() ? "0" : l.name, {}, {}, {}};
    const glm::dvec3 step(0, 0.02 * (i + 1), 0);
    if (l.type == LightType::point) e.position = l.position + step;
    if (l.type == LightType::directional) e.direction = l.direction + step;
    session.apply(e);
  }));
  edits.push_back(measured(session, ways, [&](int i) {
    PaintEdit e;
    e.stroke.points = {session.scene().camera.look_at};
    e.puff.radius = 0.2, e.puff.extinction = 1, e.seed = i;
    session.apply(e);
  }));
  for (std::size_t k = 0; k < ways.size(); ++k) {
    fmt::print("| {}, {} |", std::filesystem::path(path).stem().string(), ways[k].name());
    double rest = 1e30;
    for (const std::vector<Times>& t : edits) {
      if (!t.empty() && !t[k].refused) rest = std::min(rest, t[k].rest);
      if (t.empty()) {
        fmt::print(" - |");
      } else if (t[k].refused) {
        fmt::print(" refused |");
      } else {
        fmt::print(" {:.1f} ({:.1f}) |", 1e3 * t[k].cpu, 1e3 * t[k].wall);
      }
    }
    fmt::print(" {:.1f} |\n", 1e3 * rest);
  }
  std::fflush(stdout);
}

}  // namespace

}  // namespace airlight

int main(int argc, char** argv) {
  try {
    using namespace airlight;
    ViewWindow window("airlight-viewer", extent);
    std::deque<Way> ways;
    ways.emplace_back("CPU", window, RendererOptions{.backend = "cpu", .threads = threads});
    const bool gl = argc > 1 && std::string_view(argv[1]) == "--gl";
    if (gl) {
      ways.emplace_back("OpenGL, read back", window, RendererOptions{.backend = "gl"});
      ways.emplace_back("OpenGL, drawn directly", window, RendererOptions{.backend = "gl", .gl_host = window.render_context()});
    }
    fmt::print("| scene | camera moves | a light moves | a Gaussian is painted | all but the steps |\n|---|---|---|---|---|\n");
    for (int i = gl ? 2 : 1; i < argc; ++i) measure(argv[i], ways);
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  }
}
