// Frames of an animation, rendered one after the other by one renderer: the bits of each rendered alone, no memory that grows,
// and nothing run for what does not move.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <tuple>
#include <vector>

#include "app/airlight.h"
#include "tests/unit/scene_folder.h"

namespace airlight {
namespace {

// A lamp that flies past a square in fog, and a cloud that drifts and thins where `gaussians` says so; the camera follows.
std::string scene_text(bool gaussians, const std::string& more_tracks = "") {
  const std::string cloud = R"(, "gaussians": [ { "center": [-0.5, 0.2, 0.5], "radius": 0.6, "extinction": 2 },
                                               { "center": [0.6, 0.5, -0.5], "radius": 0.4, "extinction": 1 } ])";
  const std::string drift = R"(, "medium.gaussians[0].center": { "0": [-0.5, 0.2, 0.5], "4": [0.5, 0.2, 0.5] },
                              "medium.gaussians[*].extinction": { "0": 2, "4": 0.5 })";
  return R"({ "airlight": 1, "sky_distance": 20,
    "camera": { "position": [0, 0.5, 4], "look_at": [0, 0.5, 0], "resolution": [40, 30] },
    "medium": { "homogeneous": { "extinction": 0.1 })" +
         (gaussians ? cloud : "") + R"( },
    "lights": [ { "type": "point", "position": [-2, 1, 1], "intensity": [9, 7, 5] } ],
    "surfaces": [ { "mesh": "square.obj", "translate": [0, 0, 0], "rotate": [0, 0, 0] } ],
    "animation": { "tracks": {
      "camera.position": { "0": [0, 0.5, 4], "4": [1, 1, 4] },
      "lights[0].position": { "interpolation": "smooth", "0": [-2, 1, 1], "2": [0, 2, 1], "4": [2, 1, 1] },
      "surfaces[0].rotate": { "0": [0, 0, 0], "4": [0, 60, 20] })" +
         (gaussians ? drift : "") + more_tracks + " } } }";
}

class Sequences : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  Sequences() {
    folder.write("square.obj", square_obj);
    settings.technique = std::get<0>(GetParam());
    if (settings.technique == "illumination-network") settings.knobs = {{"particles", "256"}, {"directions", "16"}};
    if (settings.technique == "opacity-propagation") settings.knobs = {{"resolution", "16"}, {"steps", "8"}};
  }
  std::string path() const { return folder.write("scene.json", scene_text(settings.technique != "shadow-planes")); }
  RendererOptions options() const { return {.backend = std::get<1>(GetParam())}; }

  Folder folder;
  NoProgress none;
  RenderSettings settings;
};

TEST_P(Sequences, HaveTheBitsOfFramesRenderedAlone) {
  const std::string scene = path();
  SceneFile file(scene);
  Renderer warm(options());
  std::vector<float> before;
  for (const int frame : {0, 3, 1}) {
    const Frame here = warm.render(file.scene(frame, none), settings);
    SceneFile anew(scene);
    Renderer cold(options());
    const Frame alone = cold.render(anew.scene(frame, none), settings);
    ASSERT_EQ(here.image("beauty").values, alone.image("beauty").values) << "frame " << frame;
    EXPECT_NE(here.image("beauty").values, before) << "nothing moves";
    before = here.image("beauty").values;
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, Sequences,
                         testing::Combine(testing::Values("shadow-planes", "gaussian-airlight", "opacity-propagation",
                                                          "illumination-network"),
                                          testing::Values("cpu", "gl")),
                         [](const auto& row) {
                           std::string name = std::get<0>(row.param) + "_" + std::get<1>(row.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Sequence, RunsNothingForAFrameThatIsTheSame) {
  Folder folder;
  folder.write("square.obj", square_obj);
  SceneFile file(folder.write("scene.json", scene_text(true)));
  NoProgress none;
  Renderer renderer;
  const Frame last = renderer.render(file.scene(4, none), {});
  const Frame held = renderer.render(file.scene(5, none), {});  // beyond the last keyframe
  EXPECT_EQ(held.image("beauty").values, last.image("beauty").values);
  ASSERT_FALSE(held.stats.steps.empty());
  for (const StepStats& step : held.stats.steps) EXPECT_TRUE(step.reused) << step.name;
}

// What the frames of a sequence leave behind: as much after 30 as after 3.
TEST(Sequence, HoldsAsMuchMemoryAfterManyFramesAsAfterAFew) {
  Folder folder;
  folder.write("square.obj", square_obj);
  for (int k = 0; k < 31; ++k) {  // a mesh a frame, all of one size
    folder.write("wave_" + std::to_string(k) + ".obj",
                 "v 0 0 0\nv 1 0 0\nv 1 1 0." + std::to_string(10 + k) + "\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  }
  std::string text = scene_text(true);
  text.replace(text.find("\"surfaces\": ["), 13, "\"surfaces\": [ { \"mesh\": \"wave_#.obj\" },");
  text.replace(text.find("surfaces[0].rotate"), 11, "surfaces[1]");
  SceneFile file(folder.write("scene.json", text));
  NoProgress none;
  Renderer renderer({.threads = 2});
  RenderSettings settings;
  settings.technique = "opacity-propagation";
  settings.knobs = {{"resolution", "16"}, {"steps", "8"}};
  settings.resolution = Extent{80, 60};
  const auto held = [] {
    const struct mallinfo2 m = mallinfo2();
    return static_cast<double>(m.uordblks + m.hblkhd);
  };
  // What would stay if each of the last 20 frames left its smallest image behind, of one float a pixel. Before them a thread may
  // still meet its first tile of a kind, for which it gets memory once.
  constexpr std::size_t few = 10, frames = 20, smallest = 80 * 60 * sizeof(float);
  double after_few = 0;
  for (std::size_t frame = 0; frame <= few + frames; ++frame) {
    renderer.render(file.scene(static_cast<int>(frame), none), settings);
    if (frame == few) after_few = held();
  }
  const double more = held() - after_few;
  std::printf("after frame %zu: %.0f bytes, %zu frames later %+.0f; allowed %zu\n", few, after_few, frames, more,
              frames * smallest);
  EXPECT_LT(more, static_cast<double>(frames * smallest));
}

}  // namespace
}  // namespace airlight
