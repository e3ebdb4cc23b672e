// airlight edit from outside: scenes from scripts, frames of emitters, refusals.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cli/run.h"

namespace airlight {
namespace {

class Edit : public testing::Test {
 protected:
  Edit() {
    work.write("scene.json", R"({ "airlight": 1,
      "camera": { "position": [0, 1, 4], "look_at": [0, 1, 0], "resolution": [16, 12] },
      "lights": [ { "type": "point", "position": [1, 2, 0], "intensity": [9, 5, 2] } ],
      "surfaces": [ { "mesh": "floor.obj" } ] })");
    work.write("floor.obj", "v -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nf 1 2 3\nf 1 3 4\n");
    work.write("fog.jsonl",
               "{\"edit\": \"airbrush\", \"points\": [[0, 1, 0]], \"seconds\": 1, \"velocity\": [0, -3, 0], \"spread\": 1}\n"
               "{\"edit\": \"emit\", \"position\": [0, 0.5, 0], \"time\": 1}\n");
  }
  void refused(const std::string& arguments, int code, const std::string& part) {
    const std::size_t files = work.files();
    const Told told = work.run(arguments);
    EXPECT_EQ(told.code, code) << arguments << "\n" << told.err;
    EXPECT_EQ(std::count(told.err.begin(), told.err.end(), '\n'), 1) << told.err;
    EXPECT_NE(told.err.find(part), std::string::npos) << arguments << ": " << told.err;
    EXPECT_EQ(work.files(), files) << arguments;
  }
  Work work;
};

TEST_F(Edit, WritesTheSameSceneEachTime) {
  ASSERT_EQ(work.run("edit scene.json fog.jsonl -o a.json").code, 0);
  ASSERT_EQ(work.run("edit scene.json fog.jsonl -o b.json").code, 0);
  EXPECT_EQ(content(work.path("a.json")), content(work.path("b.json")));
  EXPECT_EQ(work.run("render a.json -o a.exr").err, "");
}

TEST_F(Edit, WritesASceneAFrame) {
  ASSERT_EQ(work.run("edit scene.json fog.jsonl -o at_##.json --frames 0-24x12 --fps 24").code, 0);
  ASSERT_EQ(work.run("edit scene.json fog.jsonl -o still.json").code, 0);
  EXPECT_EQ(content(work.path("at_00.json")), content(work.path("still.json")));
  EXPECT_NE(content(work.path("at_12.json")), content(work.path("at_00.json"))) << "the emitter goes on";
  work.write("later.jsonl",
             "{\"edit\": \"airbrush\", \"points\": [[0, 1, 0]], \"seconds\": 1, \"velocity\": [0, -3, 0], \"spread\": 1}\n"
             "{\"edit\": \"emit\", \"position\": [0, 0.5, 0], \"time\": 1.5}\n");
  ASSERT_EQ(work.run("edit scene.json later.jsonl -o later.json").code, 0);
  EXPECT_EQ(content(work.path("at_12.json")), content(work.path("later.json")));
}

TEST_F(Edit, RefusesWithAPlace) {
  work.write("broken.jsonl", "{\"edit\": \"undo\"}\n");
  work.write("misspelt.jsonl", "\n{\"edit\": \"erase\", \"radios\": 1}\n");
  refused("edit scene.json broken.jsonl -o out.json", 2, "broken.jsonl:1:1: nothing to undo");
  refused("edit scene.json misspelt.jsonl -o out.json", 2, "misspelt.jsonl:2:19: unknown key \"radios\"");
  refused("edit scene.json none.jsonl -o out.json", 2, "none.jsonl");
  refused("edit none.json fog.jsonl -o out.json", 2, "none.json");
  refused("edit scene.json fog.jsonl -o none/out.json", 2, "none");
  refused("edit scene.json fog.jsonl -o out.json --frames 0-3", 2, "no place for the number");
  refused("edit scene.json fog.jsonl -o out#.json --frames all", 2, "--frames: expected 12");
  refused("edit scene.json fog.jsonl -o out#.json --frames 3-1", 2, "--frames: expected 12");
}

#ifdef AIRLIGHT_VIEWER
TEST_F(Edit, IsNotDoneByHandWithoutADisplay) {
  const std::size_t files = work.files();
  const Told told = work.run("view scene.json --record record.jsonl", "env -u DISPLAY -u WAYLAND_DISPLAY");
  EXPECT_EQ(told.code, 3);
  EXPECT_EQ(told.err.substr(0, 26), "no display for a window: X");
  EXPECT_EQ(std::count(told.err.begin(), told.err.end(), '\n'), 1) << told.err;
  EXPECT_EQ(work.files(), files);
  refused("view none.json", 2, "none.json");
  refused("view scene.json --size 8", 2, "--size: expected WIDTHxHEIGHT");
  refused("view scene.json --backend vulkan", 2, "unknown backend \"vulkan\", expected cpu | gl");
}
#endif

}  // namespace
}  // namespace airlight
