// Warm frames of a moving camera allocate nothing on the CPU backend; what a frame takes besides, its plan and its images, is
// counted and bounded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "common/techniques/technique.h"
#include "cpu/backend.h"
#include "tests/unit/counted_allocations.h"
#include "tests/unit/small_work.h"

namespace airlight {
namespace {

constexpr Extent extent{200, 70};  // several tiles
constexpr int warm = 3, frames = 6;

// The camera goes to and fro, so that no frame sees more than those before it.
void move(Scene& scene, int frame) { scene.camera.position.x += frame % 2 == 0 ? 0.05 : -0.05; }

class Allocations : public testing::TestWithParam<std::string> {};

TEST_P(Allocations, WarmFramesHaveNoneInTheBackend) {
  const Technique& t = technique(GetParam());
  Work work = small_work(GetParam());
  work.set("indirect", "unbounded");
  // Of several threads each has memory of its own, and which of them works in which frame is chance.
  CpuBackend backend({.threads = 1});
  Stats stats;
  NoProgress progress;
  for (int frame = 0; frame < frames; ++frame) {
    move(work.scene, frame);
    const FrameRequest request{.extent = extent, .images = {"beauty"}, .knobs = KnobValues(t.knobs, work.settings.knobs)};
    const Plan plan = t.plan(work.scene, request);
    for (const Plan::Upload& upload : plan.uploads) {
      if (backend.holds(upload.buffer, upload.key)) continue;
      const std::vector<std::byte> bytes = upload.make();
      const long before = allocations();
      backend.upload(upload.buffer, bytes, upload.key);
      EXPECT_TRUE(allocations() == before || frame < warm) << "upload " << upload.buffer.id << " of frame " << frame;
    }
    HostImage image(extent, 3);
    const long before = allocations();
    backend.run(plan.steps, stats, progress);
    const long run = allocations() - before;
    backend.download(plan.outputs.at(0).image, image.values);
    const long all = allocations() - before;
    std::printf("%s, frame %d: %ld allocations in run(), %ld in download()\n", GetParam().c_str(), frame, run, all - run);
    EXPECT_TRUE(all == 0 || frame < warm) << all << " in frame " << frame;
    for (const StepStats& step : stats.steps) {
      EXPECT_FALSE(step.reused && (step.name == "surface_visibility" || step.name == "compose")) << step.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, Allocations,
                         testing::Values("shadow-planes", "gaussian-airlight", "opacity-propagation", "illumination-network",
                                         "marching"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace airlight
