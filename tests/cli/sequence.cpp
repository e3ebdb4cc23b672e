// Sequences from outside: which files they write, how they go on after a kill, what they refuse.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>

#include "common/scene/image_file.h"
#include "tests/cli/run.h"

namespace airlight {

namespace {

const std::string scene = R"({ "airlight": 1,
  "camera": { "position": [0, 1, 4], "look_at": [0, 1, 0], "resolution": [64, 48] },
  "medium": { "homogeneous": { "extinction": 0.1 } },
  "lights": [ { "type": "point", "position": [-1, 2, 0], "intensity": [9, 5, 2] } ],
  "animation": { "tracks": { "lights[0].position": { "0": [-1, 2, 0], "12": [1, 2, 0] } } } })";

class Sequence : public testing::Test {
 protected:
  Sequence() { work.write("scene.json", scene); }
  void refused(const std::string& arguments, const std::string& part) {
    const std::size_t files = work.files();
    const Told told = work.run(arguments);
    EXPECT_EQ(told.code, 2) << arguments;
    EXPECT_EQ(std::count(told.err.begin(), told.err.end(), '\n'), 1) << told.err;
    EXPECT_NE(told.err.find(part), std::string::npos) << arguments << ": " << told.err;
    EXPECT_EQ(told.out, "");
    EXPECT_EQ(work.files(), files) << arguments;
  }
  void renders(const std::string& arguments, const std::string& err = "") {
    const Told told = work.run("render scene.json " + arguments);
    EXPECT_EQ(told.code, 0) << arguments << ": " << told.err;
    EXPECT_EQ(told.err, err) << arguments;
    out = told.out;
  }
  // The bytes of all files whose name begins so.
  std::map<std::string, std::string> files(const std::string& begin) const {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(work.path())) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(begin)) all[name.substr(begin.size())] = content(entry.path());
    }
    return all;
  }
  Work work;
  std::string out;
};

TEST_F(Sequence, WritesAFileAFrame) {
  renders("--frames 0-12x6 -o a.####.exr --stats --stats-json a.##.json");
  EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 3) << out;
  EXPECT_EQ(out.find("frame 0: load "), 0U) << out;
  EXPECT_NE(out.find("\nframe 12: "), std::string::npos) << out;
  std::vector<std::string> names;
  for (const auto& [name, bytes] : files("a.")) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"00.json", "0000.exr", "0006.exr", "0012.exr", "06.json", "12.json"}));
  EXPECT_NE(content(work.path("a.0000.exr")), content(work.path("a.0006.exr")));
  // One alone, and the scene as it is without --frames.
  renders("--frames 6 -o b.exr");
  EXPECT_EQ(content(work.path("b.exr")), content(work.path("a.0006.exr")));
  renders("-o b.exr");
  EXPECT_EQ(content(work.path("b.exr")), content(work.path("a.0000.exr")));
  // Every image of other formats.
  renders("--frames 11-12 -o c.#.png --aov depth");
  EXPECT_EQ(files("c.").size(), 4U);
  EXPECT_EQ(files("c.").count("12.depth.png"), 1U);
  renders("--frames all -o d.#.pfm");
  EXPECT_EQ(files("d.").size(), 13U);
}

TEST_F(Sequence, KeepsWhatIsThere) {
  const std::string exr = "--frames 0-3 -o a.#.exr --aov depth --log-level info", keep = exr + " --resume";
  const auto kept = [&](const std::string& arguments) {
    const Told told = work.run("render scene.json " + arguments);
    EXPECT_EQ(told.code, 0) << told.err;
    out = told.err;
    int n = 0;
    for (std::size_t k = out.find(": kept\n"); k != out.npos; k = out.find(": kept\n", k + 1)) ++n;
    return n;
  };
  EXPECT_EQ(kept(keep), 0);
  const auto whole = files("a.");
  EXPECT_EQ(whole.size(), 4U);
  EXPECT_EQ(kept(keep), 4);
  // Each is rendered anew where something is wrong with it, and the line tells what.
  std::filesystem::remove(work.path("a.0.exr"));
  work.write("a.1.exr", whole.at("1.exr").substr(0, whole.at("1.exr").size() / 2));
  work.write("a.2.exr", whole.at("3.exr"));
  EXPECT_EQ(kept(keep), 1);
  EXPECT_NE(out.find("a.1.exr"), std::string::npos) << out;
  EXPECT_NE(out.find("a.2.exr: of another scene; rendered anew"), std::string::npos) << out;
  EXPECT_EQ(files("a."), whole);
  EXPECT_EQ(kept(keep + " --set table_nodes=16"), 0);
  EXPECT_NE(out.find("a.3.exr: of another table_nodes; rendered anew"), std::string::npos) << out;
  EXPECT_EQ(kept(keep + " --resolution 32x24"), 0);
  EXPECT_NE(out.find("of another size; rendered anew"), std::string::npos) << out;
  EXPECT_EQ(kept("--frames 0-3 -o a.#.exr --resolution 32x24 --resume --log-level info"), 0);
  EXPECT_NE(out.find("of other images; rendered anew"), std::string::npos) << out;
  EXPECT_EQ(kept(exr), 0) << "without --resume";
  EXPECT_EQ(files("a."), whole);
  // Other formats: all files of a frame, and of PNG the exposure too.
  const std::string png = "--frames 0-1 -o b.#.png --aov depth --resume --log-level info";
  EXPECT_EQ(kept(png), 0);
  std::filesystem::remove(work.path("b.1.depth.png"));
  EXPECT_EQ(kept(png), 1);
  EXPECT_NE(out.find("b.1.depth.png: no such file; rendered anew"), std::string::npos) << out;
  EXPECT_EQ(kept(png + " --exposure 1"), 0);
  const std::string pfm = "--frames 0-1 -o b.#.pfm --resume --log-level info";
  EXPECT_EQ(kept(pfm), 0);
  EXPECT_EQ(kept(pfm), 2);
}

// A run that is killed leaves whole frames and nothing else, and the next one ends with the bytes of one that was not.
TEST_F(Sequence, GoesOnAfterAKill) {
  renders("--frames 0-11 --technique reference -o whole.#.exr");
  const auto whole = files("whole.");
  ASSERT_EQ(whole.size(), 12U);
  for (const int number : {SIGTERM, SIGKILL}) {
    const pid_t child = fork();
    if (child == 0) {
      const int nowhere = open("/dev/null", O_WRONLY);
      if (chdir(work.path().c_str()) != 0 || dup2(nowhere, 2) < 0) _exit(1);
      execl(AIRLIGHT_PROGRAM, "airlight", "render", "scene.json", "--frames", "0-11", "--technique", "reference", "-o",
            "cut.#.exr", nullptr);
      _exit(1);
    }
    while (files("cut.").size() < 3 && waitpid(child, nullptr, WNOHANG) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kill(child, number);
    int status = 0;
    waitpid(child, &status, 0);
    const auto cut = files("cut.");
    std::printf("signal %d: %zu of 12 frames\n", number, cut.size());
    EXPECT_GE(cut.size(), 3U);
    EXPECT_LT(cut.size(), 12U);
    for (const auto& [name, bytes] : cut) EXPECT_EQ(bytes, whole.at(name)) << name;
    if (number != SIGKILL) {
      EXPECT_EQ(files(".airlight").size(), 0U) << "a temporary file is left";
    }
    renders("--frames 0-11 --technique reference -o cut.#.exr --resume --stats");
    std::size_t kept = 0;
    for (std::size_t k = out.find(": kept\n"); k != out.npos; k = out.find(": kept\n", k + 1)) ++kept;
    EXPECT_EQ(kept, cut.size()) << out;
    EXPECT_EQ(files("cut."), whole);
    for (const auto& [name, bytes] : whole) std::filesystem::remove(work.path("cut." + name));
  }
}

TEST_F(Sequence, IsCheckedBeforeAnythingIsRendered) {
  refused("render scene.json -o a.exr --frames 0-3", "a.exr: no place for the number of the frame");
  refused("render scene.json -o a.#.exr --frames 0-3 --stats-json s.json", "s.json: no place");
  for (const std::string frames : {"3-0", "-1", "0-3x0", "1e3", "99999999999"})
    refused("render scene.json -o a.#.exr --frames='" + frames + "'", "--frames: expected 12, 0-47, 0-47x4");
  work.write("still.json", R"({ "airlight": 1, "medium": { "homogeneous": { "extinction": 0.1 } } })");
  refused("render still.json -o a.#.exr --frames 0-3", "still.json: has no \"animation\"");
  // A file that is missing in the last frame, and what two tracks make together between their keys.
  work.write("part_0.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  work.write("parts.json", R"({ "airlight": 1, "surfaces": [ { "mesh": "part_#.obj" } ], "animation": { "frames": [0, 1] } })");
  refused("render parts.json -o a.#.exr --frames all", "parts.json:1:42: surfaces[0].mesh: part_1.obj: no such file (frame 1)");
  work.write("through.json", R"({ "airlight": 1, "camera": { "position": [0, 0, 1], "look_at": [0, 0, 0] },
    "animation": { "tracks": { "camera.position": { "0": [0, 0, 1], "2": [0, 0, -1] } } } })");
  refused("render through.json -o a.#.exr --frames 0-2",
          "through.json:1:64: camera.look_at: the same place as position, expected another (frame 1)");
}

TEST_F(Sequence, InfoTellsOfTheAnimation) {
  const Told told = work.run("info scene.json");
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_EQ(told.out.find("frames 0-12\ntracks 1\n"), 0U) << told.out;
}

}  // namespace

}  // namespace airlight
