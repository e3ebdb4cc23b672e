// Tabulated reflectances: out of files and scenes, and what is told of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "app/airlight.h"
#include "common/error.h"
#include "common/plan/brdf.h"
#include "common/scene/brdf.h"
#include "common/scene/brdf_file.h"
#include "common/scene/content_hash.h"
#include "common/scene/load.h"
#include "tests/parity/brdfs.h"
#include "tests/parity/inputs.h"
#include "tests/unit/scene_folder.h"

namespace airlight {
namespace {

// As the database stores them.
std::string file_of(const std::vector<std::uint32_t>& size, const std::vector<double>& values) {
  std::string bytes;
  const auto add = [&](std::uint64_t v, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) bytes += static_cast<char>(v >> (8 * k) & 0xffU);
  };
  for (const std::uint32_t n : size) add(n, 4);
  for (const double v : values) add(std::bit_cast<std::uint64_t>(v), 8);
  return bytes;
}

std::vector<double> counted(std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(1 + static_cast<double>(i));
  return values;
}

const std::string before = R"({ "airlight": 1, "surfaces": [ { "mesh": "square.obj", "material": { "brdf": ")";

class BrdfFiles : public testing::Test {
 protected:
  BrdfFiles() { folder.write("square.obj", square_obj); }
  Scene load(const std::string& name) const { return load_scene(folder.write("scene.json", before + name + "\" } } ] }")); }
  // One line at the file's value that names the file, and this of it.
  void expect_refused(const std::string& name, const std::string& part) const {
    std::string message;
    try {
      load(name);
    } catch (const InputError& e) {
      message = e.what();
    }
    std::cout << message << "\n";
    const std::string begin = folder.file("scene.json") + ":1:" + std::to_string(before.size()) +
                              ": surfaces[0].material.brdf: " + folder.file(name) + ": ";
    EXPECT_EQ(message.substr(0, begin.size()), begin);
    EXPECT_NE(message.find(part), message.npos) << "expected in it: " << part;
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0);
  }
  Folder folder;
};

TEST_F(BrdfFiles, KeepTheirValues) {
  folder.write("paint.binary", file_of({2, 3, 4}, counted(72)));
  const Scene scene = load("paint.binary");
  ASSERT_TRUE(scene.surfaces[0].brdf);
  const Brdf& brdf = *scene.surfaces[0].brdf;
  EXPECT_EQ(brdf.size, glm::ivec3(2, 3, 4));
  ASSERT_EQ(brdf.values.size(), 72U);
  EXPECT_FLOAT_EQ(brdf.values[0], 1.0F / 1500);
  EXPECT_FLOAT_EQ(brdf.values[24 + 5], 30 * 1.15F / 1500);
  EXPECT_FLOAT_EQ(brdf.values[71], 72 * 1.66F / 1500);
  const glm::dvec3 albedo = brdf_albedo(brdf);
  const Material& m = scene.surfaces[0].material;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(m.diffuse[c] + m.specular[c], std::min(albedo[c], 1.0), 1e-6);
}

// The nearest measured value of a smaller angle between light and viewer stands for it.
TEST_F(BrdfFiles, NegativeValuesWereNotMeasured) {
  std::vector<double> values = counted(36);
  const auto at = [](std::size_t half, std::size_t difference, std::size_t phi) { return (half * 3 + difference) * 2 + phi; };
  values[at(0, 1, 1)] = -1, values[at(0, 2, 1)] = -7, values[at(1, 0, 0)] = -1;
  folder.write("metal.binary", file_of({2, 3, 2}, values));
  const Scene scene = load("metal.binary");
  const std::vector<float>& found = scene.surfaces[0].brdf->values;
  EXPECT_EQ(found[at(0, 1, 1)], found[at(0, 0, 1)]);
  EXPECT_EQ(found[at(0, 2, 1)], found[at(0, 0, 1)]);
  EXPECT_EQ(found[at(1, 0, 0)], 0);
  EXPECT_FLOAT_EQ(found[at(1, 1, 0)], static_cast<float>(values[at(1, 1, 0)] / 1500));
}

TEST_F(BrdfFiles, BrightOnesReflectNoMoreThanAllOfScatteredLight) {
  folder.write("bright.binary", file_of({2, 2, 2}, std::vector<double>(24, 15000)));
  const Material m = load("bright.binary").surfaces[0].material;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(m.diffuse[c] + m.specular[c], 1, 1e-6);
}

TEST_F(BrdfFiles, BadOnesAreRefused) {
  const std::string good = file_of({2, 3, 4}, counted(72));
  expect_refused("absent.binary", "no such file");
  folder.write("header.binary", good.substr(0, 11));
  expect_refused("header.binary", "11 bytes, expected a header of 12");
  folder.write("cut.binary", good.substr(0, good.size() - 1));
  expect_refused("cut.binary", "587 bytes, expected 588 for 2 x 3 x 4 cells");
  folder.write("long.binary", good + " ");
  expect_refused("long.binary", "589 bytes, expected 588");
  folder.write("one.binary", file_of({2, 1, 4}, counted(24)));
  expect_refused("one.binary", "2 x 1 x 4 cells, expected 2 to 1024 an axis");
  folder.write("negative.binary", file_of({2, 0xffffffffU, 4}, counted(24)));
  expect_refused("negative.binary", "2 x -1 x 4 cells, expected 2 to 1024 an axis");
  folder.write("vast.binary", file_of({0x7fffffffU, 0x7fffffffU, 0x7fffffffU}, {}));
  expect_refused("vast.binary", "cells, expected 2 to 1024 an axis");
  folder.write("large.binary", file_of({1024, 1024, 1024}, {}));
  expect_refused("large.binary", "1024 x 1024 x 1024 cells, expected at most 5832000 in all");
  for (const auto& [bad, shown] :
       {std::pair(std::numeric_limits<double>::quiet_NaN(), "nan /sr in green of cell 1, 2, 3"),
        std::pair(std::numeric_limits<double>::infinity(), "inf /sr in green of cell 1, 2, 3"),
        std::pair(-std::numeric_limits<double>::infinity(), "-inf /sr in green of cell 1, 2, 3"),
        std::pair(1e10, "/sr in green of cell 1, 2, 3, expected a finite number of at most 1000000 /sr")}) {
    std::vector<double> values = counted(72);
    values[47] = bad;
    folder.write("bad.binary", file_of({2, 3, 4}, values));
    expect_refused("bad.binary", shown);
  }
}

TEST_F(BrdfFiles, EveryByteChangesTheHash) {
  std::set<std::string> hashes, contents;
  std::string bytes = file_of({2, 3, 4}, counted(72));
  for (const std::size_t at : {std::size_t{12}, std::size_t{300}, bytes.size() - 2}) {
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    folder.write("paint.binary", bytes);
    const Scene scene = load("paint.binary");
    EXPECT_TRUE(hashes.insert(scene.hash).second);
    contents.insert(content_hash(scene));
  }
  EXPECT_EQ(contents.size(), 2U);  // a double's last bit is none of a float's
}

// Of a table of Phong's lobe beside Lambert's, those are the nearest.
TEST(Brdfs, NearestLobesAreThoseOfTheTable) {
  auto brdf = std::make_shared<Brdf>();
  brdf->size = {48, 48, 48};
  constexpr double pi = std::numbers::pi;
  for (const glm::dvec2 share : {glm::dvec2(0.1, 0.5), glm::dvec2(0.3, 0.2), glm::dvec2(0.4, 0)}) {
    for (int i = 0; i < 48; ++i) {
      for (int j = 0; j < 48; ++j) {
        for (int k = 0; k < 48; ++k) {
          const double q = (i + 0.5) / 48, h = q * q * pi / 2, d = (j + 0.5) / 48 * pi / 2, phi = (k + 0.5) / 48 * pi;
          const double light = std::cos(h) * std::cos(d) - std::sin(h) * std::sin(d) * std::cos(phi),
                       viewer = std::cos(h) * std::cos(d) + std::sin(h) * std::sin(d) * std::cos(phi);
          // Of the mirror direction: twice both cosines with the normal, less the cosine between light and viewer.
          const double mirror = std::max(2 * light * viewer - std::cos(2 * d), 0.0);
          const double lobe = 9 / (2 * pi) * std::pow(mirror, 8) / std::max(light, 0.02);
          brdf->values.push_back(static_cast<float>(share.x / pi + share.y * lobe));
        }
      }
    }
  }
  const Material m = brdf_material(*brdf);
  std::printf("diffuse %.3f %.3f %.3f, specular %.3f %.3f %.3f, shininess %.2f\n", m.diffuse.x, m.diffuse.y, m.diffuse.z,
              m.specular.x, m.specular.y, m.specular.z, m.shininess);
  EXPECT_FLOAT_EQ(m.shininess, 8);
  // The lobe's own albedo is less than 1 by what lies below the horizon.
  EXPECT_NEAR(m.specular.x, 0.5, 0.03);
  EXPECT_NEAR(m.specular.y, 0.2, 0.03);
  EXPECT_LE(m.specular.z, 1e-3);
  EXPECT_NEAR(m.diffuse.y / m.diffuse.z, 0.75, 0.1);
}

TEST(TabulatedScenes, ReadEachFileOnce) {
  const Scene scene = load_scene(AIRLIGHT_SCENES "/gold_bunny.json");
  const SceneBrdfs brdfs = brdfs_of(scene);
  EXPECT_EQ(brdfs.all.size(), 1U);
  EXPECT_EQ(brdfs.of_surface, (std::vector<int>{0, -1, -1}));
}

TEST(TabulatedScenes, TellHowScatteredLightIsReflected) {
  Scene scene = test_scene(100);
  RenderSettings settings;
  settings.technique = "shadow-planes";
  const auto told = [&](std::string_view text) { return explain(scene, settings).find(text) != std::string::npos; };
  EXPECT_FALSE(told("Phong lobes nearest"));
  scene.surfaces[1].brdf = microfacet_table({4, 4, 4}, 0.5);
  EXPECT_TRUE(told("tabulated reflectances as the Lambert and Phong lobes nearest to them"));
  EXPECT_FALSE(told("tables of reflectances: no light"));
  scene.lights.clear();
  EXPECT_TRUE(told("tables of reflectances: no light"));
}

// Tables that no surface asks for, or no light, change nothing.
TEST(TabulatedScenes, WithoutLightAreAsTheirMaterials) {
  Scene scene = test_scene(100);
  scene.lights.clear();
  RenderSettings settings;
  settings.resolution = Extent{24, 18};
  Renderer renderer(RendererOptions{});
  const Frame material = renderer.render(scene, settings);
  scene.surfaces[1].brdf = microfacet_table({4, 4, 4}, 0.5);
  const Frame table = renderer.render(scene, settings);
  EXPECT_EQ(table.image("beauty").values, material.image("beauty").values);
}

}  // namespace
}  // namespace airlight
