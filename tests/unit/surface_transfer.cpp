// What surfaces hide of the sky: made the same by any number of threads, kept in files, left out where it is not needed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>

#include "app/airlight.h"
#include "common/formulas/double.h"
#include "common/plan/hidden_environment.h"
#include "common/plan/spherical_harmonics.h"
#include "common/transfer/transfer_file.h"
#include "common/transfer/transfer_maker.h"
#include "tests/parity/inputs.h"
#include "tests/tolerances.h"
#include "tests/unit/scene_folder.h"

namespace airlight {
namespace {

constexpr int rays = 64;

// A torus above a floor.
Scene over_floor() {
  Scene scene;
  scene.environment = Environment{nullptr, {1, 2, 3}, 0};
  scene.camera.position = {0, 1.5, 4}, scene.camera.look_at = {0, 0.3, 0};
  scene.surfaces.resize(2);
  scene.surfaces[0].mesh = wavy_torus(300);
  scene.surfaces[0].transform[3] = glm::dvec4(0, 0.6, 0, 1);
  scene.surfaces[1].mesh = square(3);
  return scene;
}

bool same(const SurfaceTransfer& a, const SurfaceTransfer& b) {
  return a.midpoints == b.midpoints && a.triangles == b.triangles && a.record == b.record && a.records == b.records;
}

TEST(SurfaceTransfers, AreTheSameForAnyNumberOfThreads) {
  const Scene scene = over_floor();
  TransferMaker one(1, false), five(5, false);
  const auto a = one.transfer(scene, rays), b = five.transfer(scene, rays);
  EXPECT_TRUE(same(*a, *b));
  EXPECT_FALSE(a->midpoints.empty());
  EXPECT_FALSE(a->records.empty());
  EXPECT_EQ(one.transfer(scene, rays), a);  // kept
  EXPECT_NE(one.transfer(scene, rays + 1), a);
}

// Triangles that are cut cover what they did, and no edge ends in the middle of another.
TEST(SurfaceTransfers, CutEdgesForBothOfTheirTriangles) {
  const Scene scene = over_floor();
  TransferMaker maker(2, false);
  const auto transfer = maker.transfer(scene, rays);
  const std::vector<std::byte> bytes = cut_positions(scene, *transfer);
  const auto* p = reinterpret_cast<const glm::vec3*>(bytes.data());
  ASSERT_EQ(bytes.size(), transfer->vertices() * sizeof(glm::vec3));
  double area = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> open;
  for (const glm::uvec4& t : transfer->triangles) {
    if (t.w != 1) continue;
    area += static_cast<double>(glm::length(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]))) / 2;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (open.erase({b, a}) == 0) open.insert({a, b});
    }
  }
  EXPECT_NEAR(area, 36, 1e-3);
  for (const auto& [a, b] : open) {  // the border alone
    const glm::dvec3 middle = glm::dvec3(p[a] + p[b]) / 2.0 + scene.camera.position;
    EXPECT_NEAR(std::max(std::fabs(middle.x), std::fabs(middle.z)), 3, 1e-5);
  }
  std::printf("%zu places more\n", transfer->midpoints.size());
}

// With a cache folder of their own.
class TransferFiles : public testing::Test {
 protected:
  TransferFiles() { set("XDG_CACHE_HOME", folder.path()); }
  ~TransferFiles() override { set("XDG_CACHE_HOME", cache_), set("HOME", home_); }
  static void set(const char* name, const std::optional<std::string>& value) {
    value ? setenv(name, value->c_str(), 1) : unsetenv(name);
  }
  static std::optional<std::string> variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? std::optional<std::string>(value) : std::nullopt;
  }
  const SurfaceTransfer& made(const Scene& scene, std::string& note) {
    TransferMaker maker(2, true);
    last_ = maker.transfer(scene, rays);
    note = maker.take_stats().at(0).note;
    return *last_;
  }
  Folder folder;
  std::shared_ptr<const SurfaceTransfer> last_;

 private:
  std::optional<std::string> cache_ = variable("XDG_CACHE_HOME"), home_ = variable("HOME");
};

TEST_F(TransferFiles, KeepThem) {
  const Scene scene = over_floor();
  const std::string content = transfer_content(scene, rays), path = transfer_path(content);
  EXPECT_EQ(path, folder.file("airlight/" + content.substr(0, 16) + ".transfer"));
  std::string note;
  const SurfaceTransfer first = made(scene, note);
  EXPECT_EQ(note, "kept in " + path);
  EXPECT_TRUE(same(made(scene, note), first));
  EXPECT_EQ(note, "read from " + path);
  // Of other surfaces, or other rays, nothing is taken, even under that name.
  Scene moved = scene;
  moved.surfaces[0].transform[3].y += 0.1;
  EXPECT_FALSE(read_transfer(path, transfer_content(moved, rays), moved));
  EXPECT_FALSE(read_transfer(path, transfer_content(scene, rays + 1), scene));
  EXPECT_NE(transfer_path(transfer_content(moved, rays)), path);
}

TEST_F(TransferFiles, DamagedOnesAreMadeAnew) {
  const Scene scene = over_floor();
  const std::string content = transfer_content(scene, rays), path = transfer_path(content);
  std::string note;
  const SurfaceTransfer first = made(scene, note);
  const std::string whole = bytes_of(path);
  std::set<std::size_t> places{0, 30, 84, 86, 93, 101, 117, whole.size() / 3, whole.size() / 2, whole.size() - 1};
  for (const std::size_t at : places) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    std::ofstream(path, std::ios::binary) << damaged;
    EXPECT_FALSE(read_transfer(path, content, scene)) << at;
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{50}, std::size_t{120}, whole.size() / 2, whole.size() - 1}) {
    std::ofstream(path, std::ios::binary) << whole.substr(0, size);
    EXPECT_FALSE(read_transfer(path, content, scene)) << size;
  }
  std::ofstream(path, std::ios::binary) << whole + "x";
  EXPECT_TRUE(same(made(scene, note), first));
  EXPECT_EQ(note, "kept in " + path);
  EXPECT_EQ(bytes_of(path), whole);
}

TEST_F(TransferFiles, StandInTheCacheFolder) {
  set("XDG_CACHE_HOME", "relative"), set("HOME", folder.path());
  EXPECT_EQ(transfer_path("0123456789abcdefg"), folder.file(".cache/airlight/0123456789abcdef.transfer"));
  set("XDG_CACHE_HOME", std::nullopt);
  EXPECT_EQ(transfer_path("0123456789abcdefg"), folder.file(".cache/airlight/0123456789abcdef.transfer"));
  set("HOME", std::nullopt);
  std::string note;
  made(over_floor(), note);
  EXPECT_EQ(note, "not kept: neither XDG_CACHE_HOME nor HOME names a folder");
}

TEST_F(TransferFiles, AreNotNeeded) {
  set("XDG_CACHE_HOME", folder.write("file", "no folder"));
  std::string note;
  made(over_floor(), note);
  std::printf("%s\n", note.c_str());
  EXPECT_TRUE(note.starts_with("not kept: "));
  EXPECT_EQ(folder.entries(), 1);
}

// A wall beside a place of the floor hides half of what is above it: the first harmonic of 1 there is pi / sqrt(4 pi), and of
// Lambert's lobe 1/2 / sqrt(4 pi).
TEST(SurfaceTransfers, HaveTheHarmonicsOfAWall) {
  Scene scene;
  scene.surfaces.resize(2);
  Mesh wall;
  wall.positions = {{-1e4F, -1e4F, -1e-2F}, {1e4F, -1e4F, -1e-2F}, {0, 2e4F, -1e-2F}};
  wall.normals.assign(3, {0, 0, 1});
  wall.triangles = {{0, 1, 2}};
  Mesh floor;
  floor.positions = {{0, 0, 0}, {1, 0, 1}, {-1, 0, 1}};
  floor.normals.assign(3, {0, 1, 0});
  floor.triangles = {{0, 1, 2}};
  scene.surfaces[0].mesh = std::make_shared<const Mesh>(wall);
  scene.surfaces[1].mesh = std::make_shared<const Mesh>(floor);
  TransferMaker maker(1, false);
  const auto transfer = maker.transfer(scene, 4096);
  const std::uint32_t number = transfer->record.at(3);
  ASSERT_LT(number, SurfaceTransfer::everything);
  const float* record = &transfer->records[number * SurfaceTransfer::record_floats];
  const double scale = std::sqrt(4 * std::numbers::pi);
  const double lambert = scale * static_cast<double>(record[0]), half = scale * static_cast<double>(record[36]);
  std::printf("of Lambert's lobe %.4f, of the sphere %.4f pi\n", lambert, half / std::numbers::pi);
  EXPECT_NEAR(lambert, 0.5, 5e-3);
  EXPECT_NEAR(half, std::numbers::pi, 2e-2);
}

// The coefficients of a product are triple products with each harmonic.
TEST(HarmonicProducts, AreTripleProducts) {
  EnvironmentHarmonics environment{};
  float hidden[36];
  double hidden_real[36];
  for (std::uint32_t k = 0; k < 36; ++k) {
    hidden[k] = static_cast<float>(uniform(310, k) - 0.5), hidden_real[k] = static_cast<double>(hidden[k]);
    for (std::uint32_t c = 0; c < 3; ++c) environment[c][k] = uniform(311 + c, k) - 0.5;
  }
  std::array<double, 108> found{};
  HarmonicProduct(environment).times(hidden, found);
  const std::vector<float> products = triple_products(6);
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < 36; ++k) {
      double one[36] = {};
      one[k] = 1;
      const double truth = f64::sh_triple_product(products.data(), environment[c].data(), hidden_real, one);
      worst = std::max(worst, std::fabs(found[c * 36 + k] - truth));
    }
  }
  std::printf("at most %.2g off\n", worst);
  EXPECT_FALSE(!(worst <= tolerance("harmonic_product")));
}

class EnvironmentShadowSteps : public testing::Test {
 protected:
  Frame render(const Scene& scene, const std::string& shadows = "on", const std::string& number = "64") {
    RenderSettings settings;
    settings.technique = "gaussian-airlight";
    settings.resolution = Extent{40, 30};
    settings.knobs = {{"environment_shadows", shadows}, {"environment_rays", number}};
    return renderer.render(scene, settings);
  }
  static int made(const Frame& frame, std::string_view step) {
    int count = 0;
    for (const StepStats& s : frame.stats.steps) count += s.name == step && !s.reused ? 1 : 0;
    return count;
  }
  static std::string reason(const Scene& scene, const std::string& shadows = "on") {
    RenderSettings settings;
    settings.knobs = {{"environment_shadows", shadows}};
    const std::string text = explain(scene, settings), name = "  shadows in the environment's light: ";
    const std::size_t at = text.find(name);
    EXPECT_EQ(text.find("hidden_environment") == text.npos, at != text.npos || !scene.environment);
    return at == text.npos ? "" : text.substr(at + name.size(), text.find(" (environment-shadows)\n", at) - at - name.size());
  }
  Renderer renderer{{.backend = "cpu"}};
};

TEST_F(EnvironmentShadowSteps, AreMadeOnce) {
  Scene scene = over_floor();
  EXPECT_EQ(made(render(scene), "surface_transfer"), 1);
  scene.camera.position.x += 0.3;
  Frame frame = render(scene);
  EXPECT_EQ(made(frame, "surface_transfer"), 0);
  EXPECT_EQ(made(frame, "hidden_environment"), 1);
  scene.environment->radiance.x = 3;
  EXPECT_EQ(made(render(scene), "surface_transfer"), 0);
  EXPECT_EQ(made(render(scene), "hidden_environment"), 0);
  EXPECT_EQ(made(render(scene, "on", "65"), "surface_transfer"), 1);
  scene.surfaces[0].transform[3].y += 0.1;
  EXPECT_EQ(made(render(scene), "surface_transfer"), 1);
  EXPECT_EQ(made(render(scene, "off"), "surface_transfer"), 0);
}

TEST_F(EnvironmentShadowSteps, AreLeftOutWithReasons) {
  Scene scene = over_floor();
  EXPECT_EQ(reason(scene), "");
  EXPECT_EQ(reason(scene, "off"), "environment_shadows = off");
  Scene other = scene;
  for (Surface& s : other.surfaces) s.casts_shadow = false;
  EXPECT_EQ(reason(other), "nothing casts a shadow");
  for (Surface& s : other.surfaces) s.casts_shadow = true, s.material.diffuse = {0, 0, 0};
  EXPECT_EQ(reason(other), "the surfaces reflect nothing");
  other.surfaces.clear();
  EXPECT_EQ(reason(other), "no surface");
  other = scene;
  other.environment.reset();
  EXPECT_EQ(reason(other), "");
}

// Where nothing stands in the way not a bit changes; where something does, it gets darker.
TEST_F(EnvironmentShadowSteps, ChangeOnlyWhatIsHidden) {
  Scene scene = over_floor();
  scene.surfaces.erase(scene.surfaces.begin());
  EXPECT_EQ(render(scene).image("beauty").values, render(scene, "off").image("beauty").values);
  scene = over_floor();
  scene.surfaces[1].material.specular = {0.2F, 0.2F, 0.2F};
  const HostImage on = render(scene).image("beauty"), off = render(scene, "off").image("beauty");
  double sum_on = 0, sum_off = 0;
  for (std::size_t i = 0; i < on.values.size(); ++i) {
    sum_on += static_cast<double>(on.values[i]), sum_off += static_cast<double>(off.values[i]);
    EXPECT_LE(on.values[i], off.values[i] * 1.01F);
  }
  std::printf("%.4f of the light is left\n", sum_on / sum_off);
  EXPECT_LT(sum_on, 0.98 * sum_off);
}

}  // namespace
}  // namespace airlight
