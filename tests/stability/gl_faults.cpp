// What the program says where OpenGL fails: one line, exit code 3, no file. The faults are those of osmesa_fault.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "tests/cli/run.h"

namespace airlight {
namespace {

struct Fault {
  const char *name, *told;
};
void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

class GlFault : public testing::TestWithParam<Fault> {};

Told run(const Work& work, const std::string& arguments, const std::string& fault) {
  return work.run(
      arguments + " --backend gl --gl-context osmesa",
      "AIRLIGHT_GL_FAULT=" + fault + " LD_LIBRARY_PATH=" + Work::quoted(AIRLIGHT_FAULTY_GL) + ":\"$LD_LIBRARY_PATH\"");
}

Told render(const Work& work, const std::string& fault) {
  work.write("scene.json", R"({ "airlight": 1, "camera": { "position": [0, 0, 5], "look_at": [0, 0, 0], "resolution": [32, 24] },
    "medium": { "phase": { "type": "isotropic" }, "homogeneous": { "extinction": 0.1 } },
    "lights": [ { "type": "point", "position": [0, 1, 0], "intensity": [9, 9, 9] } ] })");
  return run(work, "render scene.json -o out.exr", fault);
}

TEST_P(GlFault, IsToldInOneLine) {
  const Work work("airlight gl");
  const Told told = render(work, GetParam().name);
  std::printf("%s", told.err.c_str());
  EXPECT_EQ(told.code, 3);
  EXPECT_EQ(std::count(told.err.begin(), told.err.end(), '\n'), 1) << told.err;
  EXPECT_NE(told.err.find(GetParam().told), std::string::npos) << told.err;
  EXPECT_EQ(work.files(), 1U) << "a file beside the scene";
}

INSTANTIATE_TEST_SUITE_P(Faults, GlFault,
                         testing::Values(Fault{"context", "no OpenGL 4.5 core context"},
                                         Fault{"old", "OpenGL 4.5 is needed, this is 4.3"},
                                         Fault{"missing", "has no glDispatchCompute"},
                                         Fault{"texture", "at most 16 pixels a side"}, Fault{"layers", "at most 0 layers"},
                                         Fault{"storage", "at most 64 bytes"}, Fault{"memory", "out of memory"},
                                         Fault{"lost", "context is lost"}, Fault{"compile", "does not compile"}),
                         [](const auto& test) { return std::string(test.param.name); });

// Rays end where a millionth of what is seen is left, and know the light of those lamps alone that came before.
constexpr double ended = 1e-5;

// Volumes of lights that are together more than a storage buffer may have are read some lights at a time.
TEST(GlLimits, LightsWhoseVolumesDoNotFitTogether) {
  const Work work("airlight gl");
  std::string lamps;
  for (const char* x : {"-0.8", "-0.3", "0.2", "0.7"}) {
    lamps += (lamps.empty() ? "" : ", ") + std::string(R"({ "type": "point", "position": [)") + x +
             R"(, 0.4, 0.1], "intensity": [1, 2, 3] })";
  }
  work.write("scene.json", R"({ "airlight": 1, "camera": { "position": [0, 0, 5], "look_at": [0, 0, 0], "resolution": [16, 12] },
    "medium": { "gaussians": [ { "center": [0, 0, 0], "radius": 0.5, "extinction": 1 } ] },
    "lights": [ )" + lamps + R"( ] })");
  for (const char* asked :
       {"--technique opacity-propagation", "--technique gaussian-airlight --set light_path=volume --set light_cells=11"}) {
    const std::string render = "render scene.json " + std::string(asked);
    const Told whole = run(work, render + " -o whole.exr", "none"), parts = run(work, render + " -o parts.exr", "small");
    ASSERT_EQ(whole.code, 0) << whole.err;
    ASSERT_EQ(parts.code, 0) << parts.err;
    const std::string told = work.run("compare parts.exr whole.exr").out;
    double error = 1;
    EXPECT_EQ(std::sscanf(told.c_str(), "relative RMSE %lf", &error), 1) << told;
    std::printf("%s: relative RMSE %g\n", asked, error);
    EXPECT_LT(error, ended);
  }
}

// The library between hands everything on.
TEST(GlFault, NoneRenders) {
  const Work work("airlight gl");
  const Told told = render(work, "none");
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_EQ(work.files(), 2U);
}

}  // namespace
}  // namespace airlight
