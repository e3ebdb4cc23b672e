#include "app/view_worker.h"

#include <algorithm>
#include <utility>

namespace airlight {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto long_enough = std::chrono::milliseconds(400);  // a job is let finish until then, so that a drag shows pictures

}  // namespace

class ViewWorker::Stopping final : public Progress {
 public:
  explicit Stopping(ViewWorker& worker) : worker_(worker) {}
  void report(std::string_view, double fraction) override { worker_.fraction_.store(fraction, std::memory_order_relaxed); }
  bool stop_requested() const override { return worker_.stop_.load(std::memory_order_relaxed); }

 private:
  ViewWorker& worker_;
};

ViewWorker::ViewWorker(RendererOptions options, bool refines, std::function<void()> ready)
    : options_(std::move(options)), refines_(refines), ready_(std::move(ready)), thread_([this] { work(); }) {}

ViewWorker::~ViewWorker() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void ViewWorker::ask(ViewJob job) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(job);
    if (running_ && (refines_ || Clock::now() - began_ > long_enough)) stop_ = true;
  }
  wake_.notify_one();
}

std::optional<ViewPicture> ViewWorker::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(done_, std::nullopt);
}

bool ViewWorker::busy() const {
  const std::lock_guard lock(mutex_);
  return running_ || next_;
}

void ViewWorker::post(ViewPicture picture) {
  {
    const std::lock_guard lock(mutex_);
    done_ = std::move(picture);
  }
  ready_();
}

void ViewWorker::work() {
  std::optional<Renderer> renderer;
  for (;;) {
    ViewJob job;
    {
      std::unique_lock lock(mutex_);
      running_ = false;
      wake_.wait(lock, [&] { return ends_ || next_; });
      if (ends_) return;
      job = std::move(*next_);
      next_.reset();
      running_ = true;
      stop_ = false;
      began_ = Clock::now();
    }
    try {
      if (!renderer) renderer.emplace(options_);
      render(*renderer, job);
    } catch (const Interrupted&) {  // something newer waits
    } catch (const std::exception& e) {
      ViewPicture picture;
      picture.number = job.number;
      picture.full = *job.settings.resolution;
      picture.error = e.what();
      picture.complete = true;
      post(std::move(picture));
    }
  }
}

void ViewWorker::render(Renderer& renderer, const ViewJob& job) {
  Stopping progress(*this);
  const Extent full = *job.settings.resolution;
  for (const int share : {8, 4, 2, 1}) {
    if (!refines_ && share > 1) continue;
    RenderSettings settings = job.settings;
    settings.resolution = Extent{std::max(1, full.width / share), std::max(1, full.height / share)};
    settings.textures = options_.gl_host.has_value();
    const auto begin = Clock::now();
    Frame frame = renderer.render(job.scene, settings, progress);
    ViewPicture picture;
    picture.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    picture.number = job.number;
    picture.full = full;
    picture.extent = *settings.resolution;
    if (settings.textures) {
      picture.texture = frame.texture("beauty");
    } else {
      picture.image = std::move(frame.images.front().image);
    }
    picture.stats = std::move(frame.stats);
    picture.technique = frame.technique, picture.device = frame.device;
    if (job.explain) picture.plan = explain(job.scene, job.settings);
    picture.complete = share == 1;
    post(std::move(picture));
  }
}

}  // namespace airlight
