// Tiles from outside: the commands of a plan, workers that are killed, what merging gives and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/cli/run.h"

namespace airlight {

namespace {

// Tall, for several tiles; with low-resolution airlight, so that tiles need what is beyond their rows.
std::string scene_of(const std::string& power) {
  return R"({ "airlight": 1,
  "camera": { "position": [0, 1, 4], "look_at": [0, 1, 0], "resolution": [24, 200] },
  "medium": { "gaussians": [ { "center": [0, 1, 0], "radius": 0.6, "extinction": 1.5 } ] },
  "lights": [ { "type": "point", "name": "lamp", "position": [-1, 2, 0], "intensity": [)" +
         power + R"(, 5, 2] } ],
  "animation": { "tracks": { "lights[lamp].position": { "0": [-1, 2, 0], "2": [1, 2, 0] } } },
  "technique": { "name": "gaussian-airlight", "airlight_resolution": "half" } })";
}

class Farm : public testing::Test {
 protected:
  Farm() { work.write("scene.json", scene_of("9")); }
  void ok(const std::string& arguments) {
    const Told told = work.run(arguments);
    EXPECT_EQ(told.code, 0) << arguments << ": " << told.err;
    EXPECT_EQ(told.err, "") << arguments;
    out = told.out;
  }
  void refused(const std::string& arguments, const std::string& part, int code = 2) {
    const std::size_t files = work.files();
    const Told told = work.run(arguments);
    EXPECT_EQ(told.code, code) << arguments;
    EXPECT_EQ(std::count(told.err.begin(), told.err.end(), '\n'), 1) << told.err;
    EXPECT_NE(told.err.find(part), std::string::npos) << arguments << ": " << told.err;
    EXPECT_EQ(work.files(), files) << arguments;
  }
  int shell(const std::string& command) const {
    return std::system(("cd " + Work::quoted(work.path().string()) + " && " + command).c_str());
  }
  void same(const std::string& a, const std::string& b) const {
    EXPECT_FALSE(content(work.path(a)).empty()) << a;
    EXPECT_TRUE(content(work.path(a)) == content(work.path(b))) << a << " and " << b;
  }
  Work work{"airlight farm"};
  std::string out;
};

TEST_F(Farm, TilesMergeToTheBytesOfOneProcess) {
  for (const std::string n : {"3", "1", "2"}) ok("render scene.json --aov depth,airlight --tile " + n + "/3 -o t" + n + ".exr");
  ok("render scene.json --aov depth,airlight -o one.exr");
  ok("merge t2.exr t3.exr t1.exr -o all.exr");
  same("one.exr", "all.exr");
  refused("merge t1.exr t3.exr -o gap.exr", "t1.exr: rows 64 to 127 of 200 are in no tile");
  // Merged files are pictures as any: kept where they are there.
  const Told told = work.run("render scene.json --aov depth,airlight -o all.exr --resume --log-level info");
  EXPECT_NE(told.err.find("all.exr: kept"), std::string::npos) << told.err;
  refused("render scene.json --tile 1/2 -o t.png", "expected an EXR file");
  refused("render scene.json --tile 3/2 -o t.exr", "--tile: expected");
  refused("render scene.json --tile 1/201 -o t.exr", "at most 200 tiles");
}

TEST_F(Farm, PlansAreCommandsOfAShell) {
  shell("mv scene.json \"it's a scene.json\"");
  const std::string plan =
      "plan \"it's a scene.json\" --frames 0-2x2 --tiles 2 -o 'a b.#.png' --set samples=3 --aov depth --exposure 1";
  ok(plan);
  EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 4) << out;
  EXPECT_NE(out.find(" render 'it'\\''s a scene.json' --frames 2 --tile 1/2 -o 'a b.2.tile-1-of-2.exr' --resume"),
            std::string::npos)
      << out;
  work.write("tiles", out);
  ok(plan + " --merge");
  EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 2) << out;
  work.write("merges", out);
  EXPECT_EQ(shell("bash -e tiles && bash -e merges"), 0);
  // Of one tile a plan has whole pictures.
  ok("plan \"it's a scene.json\" --frames 0-2x2 -o one.#.png --set samples=3 --aov depth --exposure 1");
  work.write("tiles", out);
  EXPECT_EQ(shell("bash -e tiles"), 0);
  for (const std::string name : {"0.png", "2.png", "0.depth.png", "2.depth.png"}) same("one." + name, "a b." + name);
  refused("plan \"it's a scene.json\" -o two.png --merge", "nothing to merge");
}

// Whoever is killed, and when: a file that is there is whole.
TEST_F(Farm, LosesNothingToKilledWorkers) {
  if (shell("command -v parallel >/dev/null") != 0) GTEST_SKIP() << "GNU parallel is not installed";
  ok("plan scene.json --frames 1 --tiles 3 -o a.#.exr");
  work.write("tiles", out);
  ok("plan scene.json --frames 1 --tiles 3 -o a.#.exr --merge");
  work.write("merges", out);
  const std::string parallel = "parallel --will-cite -j3 >/dev/null 2>&1";
  for (const std::string seconds : {"0.1", "0.3"}) shell("sed 's/^/timeout --signal=KILL " + seconds + " /' tiles | " + parallel);
  EXPECT_EQ(shell(parallel + " <tiles && " + parallel + " <merges"), 0);
  ok("render scene.json --frames 1 -o one.#.exr");
  same("a.1.exr", "one.1.exr");
  // Tiles are kept only where they are of this scene, and this tile.
  const auto kept = [&](const std::string& tile) {
    return work.run("render scene.json --frames 1 --tile " + tile + " -o a.1.tile-2-of-3.exr --resume --log-level info")
               .err.find(": kept") != std::string::npos;
  };
  EXPECT_TRUE(kept("2/3"));
  work.write("scene.json", scene_of("8"));
  EXPECT_FALSE(kept("2/3"));
  EXPECT_FALSE(kept("1/3"));
}

TEST_F(Farm, LargeImagesTakeNoMoreThanTheyMay) {
  const std::string render = "render scene.json --aov depth,airlight.lamp --resolution 64x800 -o ";
  const auto held = [&](const std::string& file) {
    double most = 0;
    const std::string text = content(work.path(file));
    for (std::size_t at = 0; (at = text.find("\"held\": ", at)) != std::string::npos; ++at)
      most = std::max(most, std::strtod(text.c_str() + at + 8, nullptr));
    return most;
  };
  ok(render + "one.exr --stats-json one.json");
  ok(render + "bands.exr --stats-json bands.json --memory 2M");
  same("one.exr", "bands.exr");
  EXPECT_GT(held("bands.json"), 0);
  EXPECT_LT(held("bands.json"), 0.7 * held("one.json"));
  refused(render + "no.exr --memory 100K", "rows of this image take", 3);
  refused(render + "no.exr --memory 4X", "--memory: expected");
}

// Three MiB of a mesh, in a picture of 48 KiB.
TEST_F(Farm, LargeScenesTakeNoMoreThanTheyMay) {
  constexpr int n = 200;
  std::string plane;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) plane += "v " + std::to_string(0.05 * i - 5) + " -1 " + std::to_string(-0.05 * j) + "\n";
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int at = 1 + i + (n + 1) * j;
      for (const int other : {at + 1, at + n + 1})
        plane += "f " + std::to_string(at) + " " + std::to_string(at + n + 2) + " " + std::to_string(other) + "\n";
    }
  }
  work.write("plane.obj", plane);
  work.write("plane.json",
             R"({ "airlight": 1, "lights": [ { "type": "directional", "direction": [0, -1, 0], "irradiance": [1, 1, 1] } ],
    "medium": { "homogeneous": { "extinction": 0.1 } }, "surfaces": [ { "mesh": "plane.obj" } ] })");
  const std::string render = "render plane.json --resolution 64x64 -o ";
  refused(render + "no.exr --memory 2M", "of which the scene's meshes, grids and tables are", 3);
  ok(render + "yes.exr --memory 8M");
}

}  // namespace

}  // namespace airlight
