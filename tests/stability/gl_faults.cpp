// What the program says where OpenGL fails: one line, exit code 3, no file. The faults are those of osmesa_fault.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/cli/run.h"

namespace airlight {
namespace {

struct Fault {
  const char *name, *told;
};
void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

class GlFault : public testing::TestWithParam<Fault> {};

Told render(const Work& work, const std::string& fault) {
  work.write("scene.json", R"({ "airlight": 1, "camera": { "position": [0, 0, 5], "look_at": [0, 0, 0], "resolution": [32, 24] },
    "medium": { "phase": { "type": "isotropic" }, "homogeneous": { "extinction": 0.1 } },
    "lights": [ { "type": "point", "position": [0, 1, 0], "intensity": [9, 9, 9] } ] })");
  return work.run(
      "render scene.json -o out.exr --backend gl --gl-context osmesa",
      "AIRLIGHT_GL_FAULT=" + fault + " LD_LIBRARY_PATH=" + Work::quoted(AIRLIGHT_FAULTY_GL) + ":\"$LD_LIBRARY_PATH\"");
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

// The library between hands everything on.
TEST(GlFault, NoneRenders) {
  const Work work("airlight gl");
  const Told told = render(work, "none");
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_EQ(work.files(), 2U);
}

}  // namespace
}  // namespace airlight
