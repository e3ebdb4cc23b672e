// Renders in a thread of its own, so that the window never waits.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/airlight.h"

namespace airlight {

// What is asked for; a later job takes the place of one that waits.
struct ViewJob {
  std::uint64_t number = 0;  // rising
  Scene scene;
  RenderSettings settings;  // with a resolution
  bool explain = false;     // also the plan
};

struct ViewPicture {
  std::uint64_t number = 0;            // of its job
  Extent extent, full;                 // its resolution; the one asked for, of which this may be a coarser preview
  HostImage image;                     // linear; empty where there is a texture, until somebody reads it
  std::shared_ptr<GlTexture> texture;  // of a renderer in the window's OpenGL
  Stats stats;
  std::string technique, device;
  std::string plan;       // what explain() says, where asked for
  std::string error;      // why there is no image; else empty
  double seconds = 0;     // wall time of rendering
  bool complete = false;  // nothing better of this job comes
};

class ViewWorker {
 public:
  // `refines`: first an eighth of the resolution, then a quarter, a half, all of it. `ready` is called from the worker's thread
  // when there is a picture.
  ViewWorker(RendererOptions, bool refines, std::function<void()> ready);
  ~ViewWorker();
  ViewWorker(const ViewWorker&) = delete;
  ViewWorker& operator=(const ViewWorker&) = delete;

  // A job that runs is stopped where it refines, or has run for long.
  void ask(ViewJob);
  // The newest picture that was not taken yet.
  std::optional<ViewPicture> take();
  bool busy() const;
  double fraction() const { return fraction_.load(std::memory_order_relaxed); }  // of what runs

 private:
  class Stopping;
  void work();
  void render(Renderer&, const ViewJob&);
  void post(ViewPicture);

  RendererOptions options_;
  bool refines_;
  std::function<void()> ready_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<ViewJob> next_;
  std::optional<ViewPicture> done_;
  bool running_ = false, ends_ = false;
  std::atomic<bool> stop_{false};
  std::atomic<double> fraction_{0};
  std::chrono::steady_clock::time_point began_{};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace airlight
