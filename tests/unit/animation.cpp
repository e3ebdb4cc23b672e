// Keyframes, paths and numbered files: the scene of a frame is the one whose file has that frame's numbers in it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/scene/frame_pattern.h"
#include "common/scene/keyframes.h"
#include "common/scene/load.h"
#include "tests/unit/scene_folder.h"

namespace airlight {
namespace {

double at(const std::vector<int>& frames, const std::vector<double>& values, Interpolation how, int frame) {
  return interpolated(frames, values, how, frame);
}

TEST(Keyframes, AreMetHeldAndJoinedByLines) {
  const std::vector<int> frames{4, 10, 20};
  const std::vector<double> values{0.1, 0.7, -3};
  for (const Interpolation how : {Interpolation::linear, Interpolation::smooth}) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(at(frames, values, how, frames[i]), values[i]);
    EXPECT_EQ(at(frames, values, how, 0), 0.1);
    EXPECT_EQ(at(frames, values, how, 999), -3.0);
    EXPECT_EQ(at({7}, {0.3}, how, 3), 0.3);
    EXPECT_EQ(at({7}, {0.3}, how, 8), 0.3);
  }
  EXPECT_DOUBLE_EQ(at(frames, values, Interpolation::linear, 7), 0.4);
  EXPECT_DOUBLE_EQ(at(frames, values, Interpolation::linear, 15), -1.15);
}

TEST(Keyframes, SmoothOnesNeverLeaveTheRangeOfTwoKeys) {
  const std::vector<int> frames{0, 1000, 1100, 4000, 4500, 9000};
  const std::vector<double> values{0, 1, 1, 0.99, 30, 2e-3};
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
    const double low = std::min(values[i], values[i + 1]), high = std::max(values[i], values[i + 1]);
    double before = values[i];
    for (int f = frames[i]; f <= frames[i + 1]; ++f) {
      const double v = at(frames, values, Interpolation::smooth, f);
      ASSERT_GE(v, low) << f;
      ASSERT_LE(v, high) << f;
      // Monotone, but for the rounding of values of size `high`.
      ASSERT_GE((v - before) * (values[i + 1] - values[i]), -1e-14 * high * high) << f;
      before = v;
    }
  }
  for (int f = 1000; f <= 1100; ++f)
    ASSERT_EQ(at(frames, values, Interpolation::smooth, f), 1.0) << "what rests, rests in every bit";
}

TEST(Keyframes, SmoothOnesHaveContinuousVelocityAndRestAtTheEnds) {
  // Keys 10^5 frames apart, so that differences over one frame are velocities.
  constexpr int length = 100000;
  const std::vector<int> frames{length, 2 * length, 4 * length, 5 * length};
  const std::vector<double> values{0, 2, 3, 7};
  const auto velocity = [&](int f) {
    return (at(frames, values, Interpolation::smooth, f + 1) - at(frames, values, Interpolation::smooth, f)) * length;
  };
  double worst = 0;
  for (const int key : frames) worst = std::max(worst, std::abs(velocity(key) - velocity(key - 1)));
  std::printf("largest jump of the velocity at a key: %.2g, of velocities up to %.2g\n", worst, velocity(9 * length / 2));
  EXPECT_LT(worst, 1e-3);  // two differences over 1e-5 of a key's length: its accelerations are below 30
  EXPECT_GT(velocity(9 * length / 2), 4);
  EXPECT_NEAR(velocity(length), 0, 1e-3);
  EXPECT_NEAR(velocity(5 * length - 1), 0, 1e-3);
  // Steffen's slope where that of the parabola through three keys is steep: twice the smaller of its neighbours'.
  EXPECT_NEAR(velocity(2 * length), 1, 1e-3);
  // Even keys on a line: a line between the inner ones.
  EXPECT_NEAR(at({0, 10, 20, 30}, {0, 1, 2, 3}, Interpolation::smooth, 14), 1.4, 1e-15);
}

TEST(FramePattern, TakesTheLastRunOfSigns) {
  EXPECT_EQ(with_frame("smoke_####.vdb", 7), "smoke_0007.vdb");
  EXPECT_EQ(with_frame("smoke_##.vdb", 123), "smoke_123.vdb");
  EXPECT_EQ(with_frame("#", 0), "0");
  EXPECT_EQ(with_frame("#1/frame.###.exr", 42), "#1/frame.042.exr");
  EXPECT_EQ(with_frame("plain.exr", 42), "plain.exr");
  EXPECT_TRUE(has_frame_pattern("a#"));
  EXPECT_FALSE(has_frame_pattern("a"));
}

// A scene in which `$NAME` stands for numbers, with the animation that would move them.
const std::string moving = R"({ "airlight": 1,
  "camera": { "position": $position, "look_at": [0, 1, 0], "up": [0, 1, 0], "vertical_fov": $fov },
  "medium": { "albedo": $albedo, "homogeneous": { "extinction": $extinction },
    "gaussians": [ { "center": $center, "radius": $radius, "extinction": $each },
                   { "center": [1, 1, 1], "radius": 0.5, "extinction": $each } ],
    "grid": { "file": "grid.vdb", "scale": $scale, "translate": [0, 0, 9] } },
  "lights": [ { "type": "directional", "direction": $direction, "irradiance": [1, 1, 1] },
              { "type": "point", "name": "lamp", "position": [0, $height, 0], "intensity": $intensity } ],
  "surfaces": [ { "mesh": "square.obj", "translate": $translate, "rotate": $rotate, "scale": $size } ],
  "noise": { "amplitude": 0.5, "offset": $offset },
  "technique": { "name": "marching", "steps": $steps } $animation })";

struct Moved {
  std::string name, path, first, last, half;  // at frames 10, 30 and 20
};
const std::vector<Moved> all_moved{{"position", "camera.position", "[0, 1, 4]", "[2, 1, 5]", "[1, 1, 4.5]"},
                                   {"fov", "camera.vertical_fov", "40", "60", "50"},
                                   {"albedo", "medium.albedo", "[1, 1, 1]", "[0.5, 0.5, 1]", "[0.75, 0.75, 1]"},
                                   {"extinction", "medium.homogeneous.extinction", "0", "0.5", "0.25"},
                                   {"center", "medium.gaussians[0].center", "[0, 0, 0]", "[0, 3, 0]", "[0, 1.5, 0]"},
                                   {"radius", "medium.gaussians[0].radius", "1", "2", "1.5"},
                                   {"each", "medium.gaussians[*].extinction", "1", "3", "2"},
                                   {"scale", "medium.grid.scale", "1", "4", "2.5"},
                                   {"direction", "lights[0].direction", "[0, -1, 0]", "[0, -1, 1]", "[0, -1, 0.5]"},
                                   {"height", "lights[lamp].position[1]", "2", "3", "2.5"},
                                   {"intensity", "lights[lamp].intensity", "[8, 8, 8]", "[0, 4, 8]", "[4, 6, 8]"},
                                   {"translate", "surfaces[0].translate", "[0, 0, 0]", "[1, 0, 0]", "[0.5, 0, 0]"},
                                   {"rotate", "surfaces[0].rotate", "[0, 0, 0]", "[0, 180, 0]", "[0, 90, 0]"},
                                   {"size", "surfaces[0].scale", "1", "3", "2"},
                                   {"offset", "noise.offset", "[0, 0, 0]", "[0, 0, 4]", "[0, 0, 2]"},
                                   {"steps", "technique.steps", "16", "64", "40"}};

std::string with(std::string text, const std::string& name, const std::string& value) {
  for (std::size_t k = text.find("$" + name); k != text.npos; k = text.find("$" + name)) text.replace(k, name.size() + 1, value);
  return text;
}

class MovingScene : public testing::Test {
 protected:
  MovingScene() {
    folder.write("square.obj", square_obj);
    std::filesystem::copy_file(AIRLIGHT_TEST_DATA "/broken/grid.vdb", folder.file("grid.vdb"));
  }
  std::string path(const std::string& text) const { return folder.write("scene.json", text); }
  Folder folder;
  NoProgress none;
};

TEST_F(MovingScene, IsTheSceneWhoseFileHasItsNumbers) {
  std::string first = with(moving, "animation", ""), half = first, last = first, tracks;
  for (const Moved& m : all_moved) {
    first = with(first, m.name, m.first), half = with(half, m.name, m.half), last = with(last, m.name, m.last);
    tracks += (tracks.empty() ? "" : ",\n") + ("\"" + m.path + "\": { \"10\": " + m.first + ", \"30\": " + m.last + " }");
  }
  std::string animated = with(moving, "animation", ", \"animation\": { \"tracks\": {" + tracks + "} }");
  for (const Moved& m : all_moved) animated = with(animated, m.name, m.last);  // what stands in the file does not matter
  const std::string at_10 = load_scene(path(first)).hash, at_20 = load_scene(path(half)).hash,
                    at_30 = load_scene(path(last)).hash;
  SceneFile file(path(animated));
  EXPECT_TRUE(file.animated());
  EXPECT_EQ(file.frames(), (FrameRange{10, 30}));
  EXPECT_EQ(file.tracks(), all_moved.size());
  EXPECT_NE(at_10, at_20);
  for (const int frame : {30, 10, 20, 0, 99}) {  // in any order
    EXPECT_EQ(file.scene(frame, none).hash, frame <= 10 ? at_10 : frame == 20 ? at_20 : at_30) << frame;
  }
  EXPECT_EQ(load_scene(path(animated)).hash, at_10) << "the first frame";
  // Each number alone changes the scene: none of them is left out of the hash, or of the animation.
  for (const Moved& m : all_moved) {
    std::string one =
        with(moving, "animation", ", \"animation\": { \"tracks\": { \"" + m.path + "\": { \"1\": " + m.last + " } } }");
    for (const Moved& other : all_moved) one = with(one, other.name, other.first);
    EXPECT_NE(load_scene(path(one)).hash, at_10) << m.path;
  }
}

TEST_F(MovingScene, TakesFilesByTheNumberOfTheFrame) {
  folder.write("part_007.obj", square_obj);
  folder.write("part_008.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n");
  SceneFile file(path(R"({ "airlight": 1, "animation": { "frames": [7, 9] },
    "surfaces": [ { "mesh": "square.obj" },
                  { "mesh": "part_###.obj" } ] })"));
  EXPECT_EQ(file.frames(), (FrameRange{7, 9}));
  EXPECT_EQ(file.numbered_files(), (std::vector<std::string>{"part_###.obj"}));
  const Scene seven = file.scene(7, none), eight = file.scene(8, none), again = file.scene(8, none);
  EXPECT_EQ(seven.surfaces[1].mesh->positions[2].x, 1);
  EXPECT_EQ(eight.surfaces[1].mesh->positions[2].x, 2);
  EXPECT_EQ(seven.surfaces[0].mesh, eight.surfaces[0].mesh) << "read once";
  EXPECT_EQ(again.surfaces[1].mesh, eight.surfaces[1].mesh) << "read once";
  EXPECT_EQ(file.scene(7, none).hash, seven.hash);
  const auto told = [&](auto&& what) {
    try {
      what();
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string missing = told([&] { file.check(9); });
  std::printf("%s\n", missing.c_str());
  EXPECT_TRUE(missing.starts_with(folder.file("scene.json:3:29: "))) << missing;
  EXPECT_TRUE(missing.ends_with("part_009.obj: no such file (frame 9)")) << missing;
  EXPECT_EQ(told([&] { file.scene(9, none); }), missing);
  EXPECT_EQ(told([&] { file.check(8); }), "");
  // Files that no frame asked for any more are let go of.
  std::weak_ptr<const Mesh> part = eight.surfaces[1].mesh;
  EXPECT_EQ(part.use_count(), 2) << "of two scenes; the file holds another frame's";
}

TEST_F(MovingScene, KeepsSignsInNamesWithoutAnAnimation) {
  folder.write("part#1.obj", square_obj);
  EXPECT_EQ(load_scene(path(R"({ "airlight": 1, "surfaces": [ { "mesh": "part#1.obj" } ] })")).surfaces.size(), 1U);
}

TEST_F(MovingScene, MovesAnEnvironment) {
  std::filesystem::copy_file(AIRLIGHT_SCENES "/sky.hdr", folder.file("sky.hdr"));
  SceneFile file(path(R"({ "airlight": 1, "lights": [ { "type": "environment", "file": "sky.hdr", "scale": 1, "rotation": 0 } ],
    "animation": { "tracks": { "lights[0].scale": { "0": 1, "4": 3 }, "lights[0].rotation": { "0": 0, "4": 40 } } } })"));
  const Scene scene = file.scene(2, none);
  EXPECT_EQ(scene.environment->radiance, glm::dvec3(2));
  EXPECT_EQ(scene.environment->rotation, 20);
  EXPECT_EQ(file.scene(4, none).environment->image, scene.environment->image) << "read once";
}

}  // namespace
}  // namespace airlight
