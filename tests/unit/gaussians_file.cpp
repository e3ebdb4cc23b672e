// Files of Gaussians, particles and splats: what their numbers mean, where mistakes are told.
#include "common/scene/gaussians_file.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "common/error.h"
#include "common/scene/load.h"
#include "tests/unit/scene_folder.h"

namespace airlight {
namespace {

class GaussiansFiles : public testing::Test {
 protected:
  GaussiansFile read(const std::string& name, const std::string& bytes) const {
    NoProgress none;
    return read_gaussians_file(folder.write(name, bytes), none);
  }
  std::string message(const std::string& name, const std::string& bytes) const {
    try {
      read(name, bytes);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  void expect(const std::string& name, const std::string& bytes, const std::string& place, const std::string& part) const {
    const std::string told = message(name, bytes);
    std::cout << told << "\n";
    EXPECT_EQ(told.rfind(folder.file(name) + ":" + place, 0), 0U) << told << "\nexpected at " << place;
    EXPECT_NE(told.find(part), told.npos) << told << "\nexpected in it: " << part;
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 0);
  }
  Scene scene(const std::string& medium) const {
    NoProgress none;
    return parse_scene(R"({ "airlight": 1, "medium": )" + medium + " }", "scene.json", folder.path(), none);
  }
  Folder folder;
};

template <class T>
void add(std::string& bytes, T value, bool big) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (big == (std::endian::native == std::endian::little)) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

const std::string header_end =
    "comment before the rows stand other things\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 2\n"
    "property double x\nproperty float y\nproperty float z\nproperty short quality\nproperty float radius\nproperty float "
    "extinction\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";

TEST_F(GaussiansFiles, EveryFormatGivesTheSame) {
  const std::string ascii =
      "ply\nformat ascii 1.0\n" + header_end + "3 0 1 2\n0.1 2 -3 7 0.5 4 0 255 128\n-1e2 0 0.25 7 1.5 0 1 2 3\n";
  const GaussiansFile text = read("a.ply", ascii);
  ASSERT_EQ(text.gaussians.size(), 2U);
  EXPECT_EQ(text.gaussians[0].center, glm::dvec3(0.1, 2, -3));
  EXPECT_EQ(text.gaussians[0].radius, 0.5);
  EXPECT_EQ(text.gaussians[0].extinction, 4);
  EXPECT_EQ(text.gaussians[1].center.x, -100);
  EXPECT_TRUE(text.has_albedo);
  EXPECT_FALSE(text.has_emission);
  EXPECT_EQ(text.unused_columns, std::vector<std::string>{"quality"});
  // sRGB: its ends, the middle by its definition.
  EXPECT_EQ(text.gaussians[0].albedo.x, 0);
  EXPECT_EQ(text.gaussians[0].albedo.y, 1);
  EXPECT_NEAR(text.gaussians[0].albedo.z, std::pow((128 / 255.0 + 0.055) / 1.055, 2.4), 1e-15);

  for (const bool big : {false, true}) {
    std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + header_end;
    add(bytes, std::uint8_t{3}, big);
    for (const std::int32_t i : {0, 1, 2}) add(bytes, i, big);
    const auto row = [&](double x, float y, float z, float radius, float extinction, const std::array<std::uint8_t, 3>& rgb) {
      add(bytes, x, big), add(bytes, y, big), add(bytes, z, big), add(bytes, std::int16_t{7}, big), add(bytes, radius, big);
      add(bytes, extinction, big);
      for (const std::uint8_t c : rgb) add(bytes, c, big);
    };
    row(0.1, 2, -3, 0.5F, 4, {0, 255, 128});
    row(-100, 0, 0.25F, 1.5F, 0, {1, 2, 3});
    const GaussiansFile binary = read("b.ply", bytes);
    ASSERT_EQ(binary.gaussians.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(binary.gaussians[i].center, text.gaussians[i].center);
      EXPECT_EQ(binary.gaussians[i].radius, text.gaussians[i].radius);
      EXPECT_EQ(binary.gaussians[i].extinction, text.gaussians[i].extinction);
      EXPECT_EQ(binary.gaussians[i].albedo, text.gaussians[i].albedo);
    }
    expect("b.ply", bytes.substr(0, bytes.size() - 1), " ends at byte " + std::to_string(bytes.size() - 1), "2 vertices");
  }

  const GaussiansFile csv = read(
      "a.csv",
      "\xEF\xBB\xBF# steam\r\n extinction , x,y,z,\"radius\",albedo_r,albedo_g,albedo_b,emission_r,emission_g,emission_b,name\r\n"
      "\r\n4, 0.1,2,-3,0.5,0,1,0.25,7,8,9,a\r\n0,-1e2,0,0.25,1.5,1,1,1,0,0,0,\r\n");
  ASSERT_EQ(csv.gaussians.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(csv.gaussians[i].center, text.gaussians[i].center);
    EXPECT_EQ(csv.gaussians[i].radius, text.gaussians[i].radius);
    EXPECT_EQ(csv.gaussians[i].extinction, text.gaussians[i].extinction);
  }
  EXPECT_EQ(csv.gaussians[0].albedo, glm::dvec3(0, 1, 0.25));
  EXPECT_EQ(csv.gaussians[0].emission, glm::dvec3(7, 8, 9));
}

// The opacity of the ray through the centre, and the width of what is seen, are those of the splat.
TEST_F(GaussiansFiles, SplatsKeepTheirOpacity) {
  const std::string head = "x,y,z,nx,f_dc_0,f_dc_1,f_dc_2,f_rest_0,opacity,scale_0,scale_1,scale_2,rot_0\n";
  for (const double logit : {-5.0, 0.0, 3.0, 40.0}) {
    const GaussiansFile file =
        read("s.csv", head + "1,2,3,0,0,1.7724538509055159,-9,0.3," + std::to_string(logit) + ",-2,-3,-1,1\n");
    EXPECT_TRUE(file.splats);
    const Gaussian& g = file.gaussians.at(0);
    EXPECT_EQ(g.center, glm::dvec3(1, 2, 3));
    EXPECT_NEAR(g.radius / std::numbers::sqrt2, (std::exp(-2) + std::exp(-3) + std::exp(-1)) / 3, 1e-15);
    const double depth = g.extinction * g.radius * std::sqrt(std::numbers::pi);
    EXPECT_NEAR(-std::expm1(-depth), 1 / (1 + std::exp(-logit)), 1e-14) << logit;
    // Colours 1/2, 1 and one below 0.
    EXPECT_NEAR(g.albedo.x, 0.21404114048223255, 1e-15);
    EXPECT_EQ(g.albedo.y, 1);
    EXPECT_EQ(g.albedo.z, 0);
  }
}

TEST_F(GaussiansFiles, MistakesAreToldWhereTheyStand) {
  const std::string csv = "x,y,z,radius,extinction\n";
  expect("a.csv", "", "1:", "an empty file");
  expect("a.csv", "x,y,z,radius\n1,2,3,4\n", "1:1:", "no column \"extinction\", expected x y z radius extinction");
  expect("a.csv", "x,y,z,radius,radius,extinction\n", "1:14:", "there twice");
  expect("a.csv", "x,y,z,radius,extinction,albedo_g\n",
         "1:1:", "no column \"albedo_r\", expected albedo_r, albedo_g and albedo_b");
  expect("a.csv", csv + "1,2,3,1,1\n\n# a comment\n1,2,3, -1,1\n", "5:8:", "radius: -1, expected a number in 1e-06..1000000 m");
  expect("a.csv", csv + "1,2,3,1,1\n1,2,3,one,1\n", "3:7:", "radius: \"one\", expected a finite number");
  expect("a.csv", csv + "1,2,3,1,nan\n", "2:9:", "extinction: \"nan\"");
  expect("a.csv", csv + "1,2,3,1\n", "2:1:", "4 cells, expected 5 as in line 1");
  expect("a.csv", csv + "1,2,3,1,\n", "2:9:", "extinction: \"\"");
  expect("a.txt", "", " unknown format", "expected ply or csv");
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "property float radius\nproperty float extinction\n";
  expect("a.ply", "plx\n", "1:1:", "expected the word ply");
  expect("a.ply", "ply\nformat ascii 1.0\nelement vertex many\n", "3:16:", "expected a whole number");
  expect("a.ply", ply + "property half w\nend_header\n", "9:10:", "type \"half\"");
  expect("a.ply", ply + "property list uchar int w\nend_header\n", "3:1:", "is a list");
  expect("a.ply", ply, "8:1:", "expected end_header");
  expect("a.ply", ply + "end_header\n1 2 3 4\n", " ends at byte", "1 vertices");
  expect("a.ply", ply + "end_header\n1.00 2.00 3.00 4.00\n", "10:1:", "4 numbers, expected 5");
  expect("a.ply", ply + "end_header\n1 2 3  4 x\n", "10:10:", "extinction: \"x\"");
  expect("a.ply", ply + "end_header\n1 2 3  0 1\n", "10:8:", "radius: 0, expected a number in");
  std::string binary = ply + "end_header\n";
  binary.replace(binary.find("ascii"), 5, "binary_little_endian");
  const std::string at = std::to_string(binary.size() + 12);
  for (const float v : {1.0F, 2.0F, 3.0F, -4.0F, 5.0F}) add(binary, v, false);
  expect("a.ply", binary, " byte " + at + ":", "radius: -4");
}

TEST_F(GaussiansFiles, DamagedFilesAreRefusedOrLoaded) {
  GaussiansFile file;
  file.has_albedo = true;
  for (int i = 0; i < 4; ++i) file.gaussians.push_back({{i, 1, 2}, 1, 2, {0.5, 0.5, 0.5}, {0, 0, 0}});
  write_gaussians_file(folder.file("good.ply"), file, "four of them");
  const std::string good = bytes_of(folder.file("good.ply"));
  std::mt19937 random(3);
  int refused = 0, loaded = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = good;
    if (i % 4 == 0) bytes.resize(random() % bytes.size());
    if (i % 4 != 0) bytes[random() % bytes.size()] = static_cast<char>(random() % 256U);
    try {
      for (const Gaussian& g : read("bad.ply", bytes).gaussians)
        ASSERT_TRUE(g.radius > 0 && g.extinction >= 0 && g.albedo.x <= 1);
      ++loaded;
    } catch (const InputError& e) {
      ASSERT_EQ(std::string(e.what()).find('\n'), std::string::npos);
      ++refused;
    }
  }
  std::cout << refused << " refused, " << loaded << " loaded\n";
  EXPECT_GT(refused, 500);
}

TEST_F(GaussiansFiles, WrittenOnesAreReadAgain) {
  GaussiansFile file;
  file.has_emission = true;
  file.gaussians = {{{0.1, -2, 3e5}, 0.25, 7, {1, 1, 1}, {1, 2, 3}}, {{0, 0, 0}, 1e-3, 0, {1, 1, 1}, {0, 0, 0}}};
  write_gaussians_file(folder.file("out.ply"), file, "two of them");
  EXPECT_TRUE(is_gaussians_ply(folder.file("out.ply")));
  NoProgress none;
  const GaussiansFile again = read_gaussians_file(folder.file("out.ply"), none);
  ASSERT_EQ(again.gaussians.size(), 2U);
  EXPECT_FALSE(again.has_albedo);
  EXPECT_TRUE(again.has_emission);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again.gaussians[i].center, glm::dvec3(glm::vec3(file.gaussians[i].center)));
    EXPECT_EQ(again.gaussians[i].radius, static_cast<double>(static_cast<float>(file.gaussians[i].radius)));
    EXPECT_EQ(again.gaussians[i].extinction, file.gaussians[i].extinction);
    EXPECT_EQ(again.gaussians[i].emission, file.gaussians[i].emission);
  }
}

TEST_F(GaussiansFiles, ScenesPlaceThem) {
  folder.write("a.csv", "x,y,z,radius,extinction\n1,2,3,0.5,4\n");
  const Scene plain = scene(
      R"({ "albedo": [0.5, 0.6, 0.7], "gaussians": [ { "center": [0, 0, 0], "radius": 1, "extinction": 1 } ], "gaussians_file": "a.csv" })");
  ASSERT_EQ(plain.medium.gaussians.size(), 2U);
  EXPECT_EQ(plain.medium.gaussians[1].center, glm::dvec3(1, 2, 3));
  EXPECT_EQ(plain.medium.gaussians[1].albedo, glm::dvec3(0.5, 0.6, 0.7));
  const Scene placed = scene(
      R"({ "gaussians_file": { "file": "a.csv", "scale": 3, "size": 2, "rotate": [-90, 0, 0], "translate": [10, 0, 0], "albedo": [0.1, 0.2, 0.3] } })");
  const Gaussian& g = placed.medium.gaussians.at(0);
  EXPECT_EQ(g.center, glm::dvec3(12, 6, -4));
  EXPECT_EQ(g.radius, 1);
  EXPECT_EQ(g.extinction, 12);
  EXPECT_EQ(g.albedo, glm::dvec3(0.1, 0.2, 0.3));
  // The same Gaussians are the same scene, from wherever they come.
  EXPECT_EQ(scene(R"({ "gaussians_file": "a.csv" })").hash,
            scene(R"({ "gaussians": [ { "center": [1, 2, 3], "radius": 0.5, "extinction": 4 } ] })").hash);
  EXPECT_THROW(scene(R"({ "gaussians_file": { "file": "a.csv", "size": [1, 2, 1] } })"), InputError);
  EXPECT_THROW(scene(R"({ "gaussians_file": { "file": "a.csv", "scale": 1e6 } })"), InputError);
}

TEST_F(GaussiansFiles, FramesHaveFilesOfTheirOwn) {
  folder.write("steam_0003.csv", "x,y,z,radius,extinction\n1,2,3,0.5,4\n");
  folder.write("steam_0004.csv", "x,y,z,radius,extinction\n1,2,3,0.5,5\n1,2,3,0.5,6\n");
  SceneFile file(R"({ "airlight": 1, "animation": { "frames": [3, 4] }, "medium": { "gaussians_file": "steam_####.csv" } })",
                 "s.json", folder.path());
  NoProgress none;
  EXPECT_EQ(file.numbered_files(), std::vector<std::string>{"steam_####.csv"});
  EXPECT_EQ(file.scene(3, none).medium.gaussians.size(), 1U);
  EXPECT_EQ(file.scene(4, none).medium.gaussians.size(), 2U);
  EXPECT_THROW(file.check(5), InputError);
}

}  // namespace
}  // namespace airlight
