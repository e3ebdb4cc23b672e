// The commands that bring other programs' files in: fit, info.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "tests/cli/run.h"
#include "tests/tolerances.h"

namespace airlight {
namespace {

std::string nrrd() {
  std::string values = "NRRD0004\ntype: float\ndimension: 3\nsizes: 12 12 12\nencoding: ascii\nspacings: 0.1 0.1 0.1\n\n";
  for (int z = 0; z < 12; ++z) {
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 12; ++x)
        values += std::to_string(std::max(0, 30 - (x - 5) * (x - 5) - (y - 6) * (y - 6) - (z - 4) * (z - 4))) + " ";
    }
  }
  return values + "\n";
}

class Media : public testing::Test {
 protected:
  Media() {
    work.write("steam.csv", "x,y,z,radius,extinction\n0,1,1,0.5,0.8\n");
    work.write("ball.nrrd", nrrd());
  }
  void refused(const std::string& arguments, const std::string& part) {
    const std::size_t files = work.files();
    const Told told = work.run(arguments);
    EXPECT_EQ(told.code, 2) << arguments << "\n" << told.err;
    EXPECT_EQ(std::count(told.err.begin(), told.err.end(), '\n'), 1) << told.err;
    EXPECT_NE(told.err.find(part), std::string::npos) << told.err;
    EXPECT_EQ(told.out, "");
    EXPECT_EQ(work.files(), files) << arguments;
  }
  Work work;
};

TEST_F(Media, FitsWithTheSameBytesOnAnyThreads) {
  const Told one = work.run("fit ball.nrrd -n 12 --steps 30 -o one.ply --threads 1");
  ASSERT_EQ(one.code, 0) << one.err;
  std::cout << one.out;
  EXPECT_EQ(one.err, "");  // no terminal, no progress
  EXPECT_EQ(one.out.rfind("12 Gaussians; relative L2 error: density ", 0), 0U) << one.out;
  ASSERT_EQ(work.run("fit ball.nrrd -n 12 --steps 30 -o three.ply --threads 3 --quiet").out, "");
  EXPECT_EQ(content(work.path("one.ply")), content(work.path("three.ply")));
  refused("fit ball.nrrd -o ball.json", "expected a name that ends with .ply");
  refused("fit ball.nrrd -n 0 -o ball.ply", "--count");
  refused("fit gone.vdb -o gone.ply", "gone.vdb: no such file");
  refused("fit steam.csv -o steam.ply", "not an OpenVDB file");
}

// The shipped plume as Gaussians, the grid by opacity-propagation, and the plume's scene without it, beside the grid in the
// reference.
TEST_F(Media, FittedPlumeLooksLikeItsGrid) {
  const std::string scenes = std::string(AIRLIGHT_SCENES) + "/", more = " --resolution 24x18 --quiet -o ";
  ASSERT_EQ(work.run("render " + scenes + "smoke.json" + more + "truth.exr --technique reference --set tolerance=1e-4").code, 0);
  ASSERT_EQ(work.run("render " + scenes + "smoke.json" + more + "propagated.exr --technique opacity-propagation").code, 0);
  ASSERT_EQ(work.run("render " + scenes + "fitted_plume.json" + more + "gaussians.exr").code, 0);
  std::string clear = content(scenes + "fitted_plume.json");
  for (const std::string name : {"\"ground.obj\"", "\"fitted_plume.ply\""}) clear.replace(clear.find(name), 1, "\"" + scenes);
  clear.replace(clear.find("\"scale\": 6"), 10, "\"scale\": 0");
  work.write("clear.json", clear);
  ASSERT_EQ(work.run("render clear.json" + more + "clear.exr").code, 0);
  const auto error = [&](const std::string& image) {
    const std::string told = work.run("compare " + image + " truth.exr --tolerance 9").out, what = "relative RMSE ";
    return told.rfind(what, 0) == 0 ? std::stod(told.substr(what.size())) : 9;
  };
  const double gaussians = error("gaussians.exr"), nothing = error("clear.exr");
  std::printf("relative RMSE: Gaussians %.2f %%, grid by opacity-propagation %.2f %%, no smoke %.0f %%\n", 100 * gaussians,
              100 * error("propagated.exr"), 100 * nothing);
  EXPECT_LE(gaussians, tolerance("fitted_plume"));
  EXPECT_GT(nothing, 5 * tolerance("fitted_plume"));  // or the picture would tell nothing
}

TEST_F(Media, InfoTellsWhatIsInFiles) {
  const auto info = [&](const std::string& file) {
    const Told told = work.run("info " + file);
    EXPECT_EQ(told.code, 0) << told.err;
    return told.out;
  };
  EXPECT_EQ(info("steam.csv"),
            "1 Gaussians\n  box (-0.5, 0.5, 0.5) to (0.5, 1.5, 1.5) m\n"
            "  radius 0.5 to 0.5 m, extinction 0.8 to 0.8 1/m\n");
  EXPECT_NE(
      info("ball.nrrd").find("values up to 30\n  cells (0, 1, 0) to (10, 11, 9), 11 x 11 x 10\n  box (-0.05, 0.05, -0.05) to"),
      std::string::npos)
      << info("ball.nrrd");
  const std::string vdb = info(AIRLIGHT_SCENES "/smoke_plume_0045.vdb");
  std::cout << vdb;
  EXPECT_NE(vdb.find("grid \"density\": float"), std::string::npos);
  EXPECT_NE(vdb.find("grid \"velocity\": vec3s"), std::string::npos);
}

}  // namespace
}  // namespace airlight
