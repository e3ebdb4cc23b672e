// The commands that bring other programs' files in: fit, info, convert, fog from the command line.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "common/scene/image_file.h"
#include "tests/cli/run.h"
#include "tests/tolerances.h"

namespace airlight {
namespace {

std::string base64(const std::string& bytes) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned v = 0;
    for (std::size_t k = 0; k < 3; ++k) v = v << 8U | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (unsigned k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[v >> (18 - 6 * k) & 63U];
  }
  return out;
}

// A floor and a wall of two materials, a lamp and a sun, a camera that looks at them through what the extras say.
std::string gltf() {
  const std::vector<float> corners{-4, 0, -4, -4, 0, 4,     4, 0, 4,     4,  0, -4,  // the floor
                                   -1, 0, -2, 1,  0, -1.5F, 1, 2, -1.5F, -1, 2, -2};
  const std::vector<std::uint16_t> indices{0, 1, 2, 0, 2, 3};
  std::string bytes(4 * corners.size() + 2 * indices.size(), '\0');
  std::memcpy(bytes.data(), corners.data(), 4 * corners.size());
  std::memcpy(bytes.data() + 4 * corners.size(), indices.data(), 2 * indices.size());
  return R"({ "asset": { "version": "2.0" }, "scene": 0,
  "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_ior"],
  "scenes": [ { "nodes": [0, 1, 2, 3], "extras": { "airlight": {
     "medium": { "homogeneous": { "extinction": 0.05 }, "gaussians_file": "steam.csv" }, "sky_distance": 100 } } } ],
  "nodes": [ { "mesh": 0, "rotation": [0, 0.0871557, 0, 0.9961947] },
             { "camera": 0, "translation": [0.5, 1, 6], "rotation": [-0.0610485, 0, 0, 0.9981348] },
             { "translation": [1, 3, 1], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
             { "rotation": [-0.5, 0.1, 0.2, 0.8366600], "extensions": { "KHR_lights_punctual": { "light": 1 } } } ],
  "cameras": [ { "type": "perspective", "perspective": { "yfov": 0.8, "znear": 0.1, "aspectRatio": 1.5 } } ],
  "extensions": { "KHR_lights_punctual": { "lights": [
     { "type": "point", "color": [1, 0.8, 0.3], "intensity": 6830, "range": 20 }, { "type": "directional", "intensity": 341.5 } ] } },
  "materials": [ { "pbrMetallicRoughness": { "baseColorFactor": [0.8, 0.2, 0.1, 1], "metallicFactor": 0, "roughnessFactor": 0.4 },
                   "emissiveFactor": [1, 0, 0] },
                 { "pbrMetallicRoughness": { "baseColorFactor": [1, 0.7, 0.3, 1], "metallicFactor": 1, "roughnessFactor": 0.6 } } ],
  "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 }, "indices": 2, "material": 0 },
                                { "attributes": { "POSITION": 1 }, "indices": 2, "material": 1 } ] } ],
  "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-4, 0, -4], "max": [4, 0, 4] },
                 { "bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, 0, -2], "max": [1, 2, -1.5] },
                 { "bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR" } ],
  "bufferViews": [ { "buffer": 0, "byteOffset": 0, "byteLength": 48 }, { "buffer": 0, "byteOffset": 48, "byteLength": 48 },
                   { "buffer": 0, "byteOffset": 96, "byteLength": 12 } ],
  "buffers": [ { "byteLength": 108, "uri": "data:application/octet-stream;base64,)" +
         base64(bytes) + "\" } ] }";
}

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
    work.write("scene.gltf", gltf());
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

// The converted scene is the same scene, from another folder as well: the picture has the same bits.
TEST_F(Media, ConvertedScenesAreTheSame) {
  const Told told = work.run("convert scene.gltf -o scene.json");
  ASSERT_EQ(told.code, 0) << told.err;
  EXPECT_EQ(told.out, "");
  std::cout << told.err << content(work.path("scene.json"));
  EXPECT_NE(told.err.find("emission of materials is left out"), std::string::npos) << told.err;
  EXPECT_NE(told.err.find("extension \"KHR_materials_ior\" is left out"), std::string::npos) << told.err;
  std::filesystem::create_directory(work.path("below"));
  ASSERT_EQ(work.run("convert scene.gltf -o below/scene.json").code, 0);
  ASSERT_EQ(work.run("convert scene.gltf -o clear.json --fog 0").code, 0);
  const auto render = [&](const std::string& scene) {
    EXPECT_EQ(work.run("render " + scene + " -o a.pfm --resolution 48x32 --quiet").code, 0) << scene;
    return content(work.path("a.pfm"));
  };
  const std::string truth = render("scene.gltf"), clear = render("scene.gltf --fog 0");
  EXPECT_EQ(render("scene.json"), truth);
  EXPECT_EQ(render("below/scene.json"), truth);
  EXPECT_EQ(render("clear.json"), clear);
  EXPECT_NE(truth, clear);
  EXPECT_EQ(render("scene.json --fog 0.05"), truth);
  EXPECT_EQ(render("scene.json --visibility 78.24"), truth);  // 3.912 / 0.05
  EXPECT_NE(render("scene.json --fog 0.1"), truth);
}

TEST_F(Media, MeshesBecomeScenes) {
  work.write("floor.obj", "v -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nf 1 2 3\nf 1 3 4\n");
  ASSERT_EQ(work.run("convert floor.obj -o floor.json --fog 0.01").code, 0);
  ASSERT_EQ(work.run("render floor.json -o a.pfm --resolution 24x18").code, 0);
  const HostImage image = read_image(work.path("a.pfm").string());
  EXPECT_GT(*std::max_element(image.values.begin(), image.values.end()), 0.1F);
  refused("convert floor.obj -o floor.txt", "expected a name that ends with .json");
  refused("convert gone.glb -o gone.json", "gone.glb: no such file");
  refused("render floor.json -o a.exr --fog 1 --visibility 2", "excludes");
}

// A spot light is taken for a point light, and what is lost is told.
TEST_F(Media, SpotLightsLoseTheirCones) {
  std::string spot = gltf();
  const std::string point = "\"type\": \"point\"";
  spot.replace(spot.find(point), point.size(), R"("type": "spot", "spot": { "innerConeAngle": 0.2, "outerConeAngle": 0.5 })");
  work.write("spot.gltf", spot);
  const Told told = work.run("convert spot.gltf -o spot.json");
  ASSERT_EQ(told.code, 0) << told.err;
  EXPECT_NE(told.err.find("spot.gltf: the cones of spot lights are left out, they shine in all directions\n"), std::string::npos);
  EXPECT_NE(told.err.find("spot.gltf: the range of lights is left out, they shine on\n"), std::string::npos) << told.err;
  ASSERT_EQ(work.run("convert scene.gltf -o point.json").code, 0);
  std::string same = content(work.path("spot.json"));
  for (std::size_t at = 0; (at = same.find("spot.gltf", at)) != std::string::npos;) same.replace(at, 9, "scene.gltf");
  EXPECT_EQ(same, content(work.path("point.json")));
  EXPECT_EQ(work.run("render spot.gltf -o a.pfm --resolution 16x12").err, told.err);
  EXPECT_TRUE(work.run("info spot.gltf").out.ends_with(told.err));
}

// What would take all memory takes its own process's, and the program tells so.
TEST_F(Media, HugeMeshesAreRefused) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "memory is not bounded under a sanitizer";
#endif
  work.write("huge.off", "OFF\n2000000000 2000000000 0\n0 0 0\n");
  refused("info huge.off", "huge.off: takes more than 4096 MiB of memory to read, expected less");
  refused("convert huge.off -o huge.json", "huge.off: takes more than 4096 MiB of memory to read");
}

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

// The shipped plume as Gaussians (of smaller pictures a square of pixels has fewer panels than so many need), the grid by
// opacity-propagation, and the plume's scene without it, beside the grid in the reference.
TEST_F(Media, FittedPlumeLooksLikeItsGrid) {
  const std::string scenes = std::string(AIRLIGHT_SCENES) + "/", more = " --resolution 80x60 --quiet -o ";
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
