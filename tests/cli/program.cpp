// The program from outside: what it writes, what it says, how it ends.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "common/scene/image_file.h"
#include "common/scene/sha256.h"
#include "tests/cli/run.h"

namespace airlight {

namespace {

const std::string scene = R"({ "airlight": 1,
  "camera": { "position": [0, 1, 4], "look_at": [0, 1, 0], "resolution": [96, 72] },
  "medium": { "homogeneous": { "extinction": 0.1 }, "ambient": [0.1, 0.1, 0.1] },
  "lights": [ { "type": "point", "name": "lamp", "position": [1, 2, 0], "intensity": [9, 5, 2] },
              { "type": "directional", "direction": [0, -1, 0.2], "irradiance": [0.5, 0.5, 1] } ],
  "surfaces": [ { "mesh": "floor.obj" } ] })";
const std::string floor_obj = "v -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nf 1 2 3\nf 1 3 4\n";

class Program : public testing::Test {
 protected:
  Program() {
    work.write("scene.json", scene);
    work.write("floor.obj", floor_obj);
  }
  // Refused with `code`: one line on standard error that has `part` in it, nothing on standard output, no new file.
  void refused(const std::string& arguments, int code, const std::string& part, const std::string& before = "") {
    const std::size_t files = work.files();
    const Told told = work.run(arguments, before);
    EXPECT_EQ(told.code, code) << arguments << "\n" << told.err;
    EXPECT_EQ(std::count(told.err.begin(), told.err.end(), '\n'), 1) << told.err;
    EXPECT_NE(told.err.find(part), std::string::npos) << arguments << ": " << told.err;
    EXPECT_EQ(told.out, "");
    EXPECT_EQ(work.files(), files) << arguments;
  }
  HostImage image(const std::string& name) const { return read_image(work.path(name).string()); }
  std::string hash(const std::string& name) const {
    Sha256 h;
    h.add(content(work.path(name)));
    return h.hex();
  }
  Work work;
};

TEST_F(Program, WritesAnImage) {
  const Told told = work.run("render scene.json -o fog.exr");
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_EQ(told.out + told.err, "");
  EXPECT_EQ(work.files(), 3U);
  const HostImage fog = image("fog.exr");
  EXPECT_EQ(fog.extent, (Extent{96, 72}));
  EXPECT_EQ(fog.channels, 3);
  EXPECT_GT(*std::max_element(fog.values.begin(), fog.values.end()), 0.1F);
}

TEST_F(Program, WritesTheSameBytesWhateverRunsIt) {
  ASSERT_EQ(work.run("render scene.json -o a.exr --aov depth,airlight.lamp").code, 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // another second: no time of day may be in the file
  ASSERT_EQ(work.run("render scene.json -o b.exr --aov depth,airlight.lamp --threads 3 --simd scalar").code, 0);
  EXPECT_EQ(hash("a.exr"), hash("b.exr"));
  ASSERT_EQ(work.run("render scene.json -o a.png").code, 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  ASSERT_EQ(work.run("render scene.json -o b.png --threads 1").code, 0);
  EXPECT_EQ(hash("a.png"), hash("b.png"));
  ASSERT_EQ(work.run("render scene.json -o c.png --exposure 0.01").code, 0);
  EXPECT_NE(hash("a.png"), hash("c.png")) << "the comparison sees nothing";
}

TEST_F(Program, BeautyIsTheSumOfItsStoredParts) {
  for (const std::string more : {"", " --supersample 2", " --technique reference --resolution 24x18",
                                 " --technique reference --resolution 4x3 --set indirect=exact --set indirect_tolerance=0.1"}) {
    ASSERT_EQ(work.run("render scene.json -o fog.exr --aov surface,airlight" + more).code, 0);
    const std::vector<NamedImage> images = read_images(work.path("fog.exr").string());
    ASSERT_EQ(images.size(), 3U);
    ASSERT_EQ(images[0].name, "");
    const auto part = [&](const std::string& name) -> const HostImage& {
      return std::find_if(images.begin(), images.end(), [&](const NamedImage& i) { return i.name == name; })->image;
    };
    const HostImage &surface = part("surface"), &airlight = part("airlight");
    for (std::size_t i = 0; i < surface.values.size(); ++i) {
      ASSERT_EQ(images[0].image.values[i], surface.values[i] + airlight.values[i]) << more;
    }
  }
}

TEST_F(Program, EveryImageItNamesCanBeWritten) {
  const std::string names =
      "surface,surface.direct,surface.indirect,surface.ambient,transmittance,airlight,airlight.lamp,airlight.1,depth,normal,"
      "optical_depth";
  ASSERT_EQ(work.run("render scene.json -o fog.exr --aov " + names).code, 0);
  EXPECT_EQ(read_images(work.path("fog.exr").string()).size(), 12U);
  ASSERT_EQ(work.run("render scene.json -o fog.pfm --aov depth").code, 0);
  EXPECT_EQ(image("fog.depth.pfm").channels, 1);
  for (const std::string extension : {"tif", "hdr", "png", "jpg", "bmp", "tga", "ppm"}) {
    EXPECT_EQ(work.run("render scene.json -o fog." + extension).code, 0) << extension;
    EXPECT_EQ(image("fog." + extension).extent, (Extent{96, 72})) << extension;
  }
}

// Four times the paths or four samples a pixel: half the standard error.
TEST_F(Program, TellsTheErrorOfRandomPaths) {
  const auto middle_error = [&](const std::string& more) {
    const Told told = work.run(
        "render scene.json -o a.exr --technique reference --resolution 8x6 --set max_bounces=3 --aov "
        "standard_error " +
        more);
    EXPECT_EQ(told.code, 0) << told.err;
    std::vector<float> values;
    for (const NamedImage& i : read_images(work.path("a.exr").string())) {
      if (i.name != "standard_error") continue;
      EXPECT_EQ(i.image.channels, 3);
      values = i.image.values;
    }
    EXPECT_EQ(values.size(), 3U * 8 * 6);
    std::sort(values.begin(), values.end());
    return static_cast<double>(values.at(values.size() / 2));
  };
  const double once = middle_error("--set paths=100");
  EXPECT_GT(once, 0);
  for (const std::string more : {"--set paths=400", "--set paths=100 --supersample 2"}) {
    const double ratio = middle_error(more) / once;
    std::printf("%s: %.3f of the standard error\n", more.c_str(), ratio);
    EXPECT_NEAR(ratio, 0.5, 0.1);
  }
  EXPECT_EQ(middle_error("--set paths=100 --threads 3"), once);
  EXPECT_NE(middle_error("--set paths=100 --set seed=1"), once);
}

TEST_F(Program, GlGivesTheSameImage) {
  ASSERT_EQ(work.run("render scene.json -o cpu.exr --aov airlight").code, 0);
  const Told told = work.run("render scene.json -o gl.exr --aov airlight --backend gl --gl-context osmesa");
  ASSERT_EQ(told.code, 0) << told.err;
  const Told same = work.run("compare gl.exr cpu.exr --tolerance 1e-4");
  EXPECT_EQ(same.code, 0) << same.out;
  std::printf("%s", same.out.c_str());
  EXPECT_EQ(work.run("compare gl.exr cpu.exr --image airlight --tolerance 1e-4").code, 0);
}

TEST_F(Program, CompareSaysWhetherImagesDiffer) {
  ASSERT_EQ(work.run("render scene.json -o a.exr").code, 0);
  ASSERT_EQ(work.run("render scene.json -o b.exr --set table_nodes=16").code, 0);
  EXPECT_EQ(work.run("compare a.exr a.exr").code, 0);
  const Told told = work.run("compare b.exr a.exr");
  EXPECT_EQ(told.code, 1);
  EXPECT_NE(told.out.find("relative RMSE"), std::string::npos);
  refused("compare a.exr none.exr", 2, "none.exr");
  refused("compare a.exr a.exr --image depth", 2, "depth");
}

TEST_F(Program, ChoosesForAGoal) {
  const Told told = work.run("render scene.json -o a.pfm --error 1%");
  EXPECT_EQ(told.code, 0);
  EXPECT_NE(told.out.find("shadow-planes table_nodes=16: "), std::string::npos) << told.out;
  EXPECT_NE(work.run("explain scene.json --budget 30s").out.find("chosen: shadow-planes"), std::string::npos);
  refused("render scene.json -o b.pfm --error 0.00001%", 2, "expected to meet");
  refused("render scene.json -o b.pfm --error 1ms", 2, "such as 1% or 0.01");
  refused("render scene.json -o b.pfm --error 1% --budget 1s", 2, "expected one of them");
  refused("render scene.json -o b.pfm --error 1% --set table_nodes=16", 2, "expected one of the two");
  refused("render scene.json -o b.pfm --budget 1s --backend gl", 2, "--budget");
}

TEST_F(Program, ExplainsAndCounts) {
  const Told told = work.run("explain scene.json");
  EXPECT_EQ(told.code, 0);
  for (const std::string word :
       {"shadow-planes", "table_nodes = 64", "surface_visibility", "shadow_planes", "homogeneous_airlight"}) {
    EXPECT_NE(told.out.find(word), std::string::npos) << word << "\n" << told.out;
  }
  const Told counted = work.run("render scene.json -o a.exr --stats --stats-json stats.json");
  EXPECT_NE(counted.out.find("surface_shading"), std::string::npos);
  EXPECT_NE(content(work.path("stats.json")).find("\"technique\": \"shadow-planes\""), std::string::npos);
}

TEST_F(Program, HelpListsWhatWorks) {
  EXPECT_EQ(work.run("--help").code, 0);
  const Told told = work.run("render --help");
  EXPECT_EQ(told.code, 0);
  for (const std::string word : {"table_nodes", "--technique", "gaussian-airlight", "opacity-propagation", "illumination-network",
                                 "marching", "reference", "--frames", "--resume", "Examples"})
    EXPECT_NE(told.out.find(word), std::string::npos) << word;
  EXPECT_EQ(told.out.find("--seed"), std::string::npos);
  EXPECT_EQ(work.run("--version").out.substr(0, 9), "airlight ");
}

TEST_F(Program, RefusesWhatItCannotDo) {
  refused("", 2, "subcommand");
  refused("render scene.json", 2, "--output");
  refused("render scene.json -o a.exr --colour", 2, "--colour");
  refused("render none.json -o a.exr", 2, "none.json: no such file");
  refused("render . -o a.exr", 2, "directory");
  refused("render scene.json -o a.xyz", 2, "xyz");
  refused("render scene.json -o .", 2, "");
  refused("render scene.json -o nowhere/a.exr", 2, "nowhere");
  refused("render scene.json -o scene.json/a.exr", 2, "scene.json");
  refused("render scene.json -o a.exr --resolution 100000x100000", 2, "65535");
  refused("render scene.json -o a.exr --resolution 0x4", 2, "1..65535");
  refused("render scene.json -o a.exr --resolution 4", 2, "WIDTHxHEIGHT");
  refused("render scene.json -o a.exr --set table_nodes=9", 2, "16..128");
  refused("render scene.json -o a.exr --set table_node=64", 2, "table_nodes");
  refused("render scene.json -o a.exr --set x", 2, "NAME=VALUE");
  refused("render scene.json -o a.exr --aov dept", 2, "did you mean \"depth\"");
  refused("render scene.json -o a.exr --aov standard_error", 2, "only technique reference");
  refused("render scene.json -o a.exr --technique reference --set max_bounces=2000", 2, "max_bounces: fog without bounds");
  refused("render scene.json -o a.exr --technique reference --set paths=1", 2, "expected an integer in 2..");
  refused("render scene.json -o a.exr --simd sse", 2, "scalar");
  refused("render scene.json -o a.exr --simd neon", 3, "NEON");
  refused("render scene.json -o a.exr --backend vulkan", 2, "cpu | gl");
  refused("render scene.json -o a.exr --backend gl --gl-context glx", 2, "osmesa");
  refused("render scene.json -o a.exr --backend gl --gl-context osmesa --gl-device 1", 3, "OSMesa");
  refused("render scene.json -o a.exr --backend gl --technique reference", 2, "reference");
  refused("render scene.json -o a.exr --technique shadow-planes --set indirect=exact", 2, "unbounded | off");
  refused("render scene.json -o a.exr --technique radiosity", 2, "radiosity");
  refused("render scene.json -o a.exr --supersample 17", 2, "1..16");
  refused("render scene.json -o a.exr --tonemap filmic", 2, "reinhard");
}

TEST_F(Program, LosesNothingWhenItFails) {
  work.write("old.exr", "precious");
  work.write("bad.json", "{ \"airlight\": 1, \"medium\": { \"albedo\": [1.1, 0, 0] } }");
  refused("render bad.json -o old.exr", 2, "bad.json:1:41");
  EXPECT_EQ(content(work.path("old.exr")), "precious");
  // A disk that is full: files may not grow beyond one block.
  refused("render scene.json -o old.exr", 3, "old.exr", "ulimit -f 1 &&");
  EXPECT_EQ(content(work.path("old.exr")), "precious");
  const Told told = work.run("info 2>&1 >/dev/full; exit $?");
  EXPECT_EQ(told.code, 3);
}

TEST_F(Program, SpacesAndForeignLettersAreNames) {
  std::filesystem::create_directory(work.path("né bel"));
  work.write("né bel/scène 1.json", scene);
  work.write("né bel/floor.obj", floor_obj);
  EXPECT_EQ(work.run("render 'né bel/scène 1.json' -o 'né bel/brouillard épais.exr'").code, 0);
  EXPECT_EQ(image("né bel/brouillard épais.exr").extent, (Extent{96, 72}));
}

TEST_F(Program, StopsWithinAMoment) {
  work.write("large.json", scene);
  for (const int number : {SIGINT, SIGTERM}) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
      if (chdir(work.path().c_str()) != 0 || dup2(ends[1], 2) < 0) _exit(1);
      execl(AIRLIGHT_PROGRAM, "airlight", "render", "large.json", "-o", "large.exr", "--technique", "reference", "--resolution",
            "3000x2000", "--log-level", "debug", nullptr);
      _exit(1);
    }
    // It says that the scene is loaded; a little later it renders, however busy the machine is.
    close(ends[1]);
    char told = 0;
    EXPECT_EQ(read(ends[0], &told, 1), 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const auto start = std::chrono::steady_clock::now();
    kill(child, number);
    int status = 0;
    waitpid(child, &status, 0);
    close(ends[0]);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("signal %d: stopped after %.3f s\n", number, seconds);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 130);
    EXPECT_LT(seconds, 2.0) << "0.2 s on a machine that is not busy";
    EXPECT_EQ(work.files(), 3U) << "a temporary file is left";
  }
}

}  // namespace

}  // namespace airlight
