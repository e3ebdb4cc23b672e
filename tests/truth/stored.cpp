// The stored images against the reference as it is now; make them again with ./dev truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "common/scene/content_hash.h"
#include "common/scene/image_file.h"
#include "tests/tolerances.h"
#include "tests/truth/truth_scenes.h"

namespace airlight {
namespace {

const std::string folder = AIRLIGHT_TEST_DATA "/truth/";

std::map<std::string, std::string> stored_hashes() {
  std::ifstream in(folder + "hashes.txt");
  std::map<std::string, std::string> hashes;
  for (std::string name, hash; in >> name >> hash;) hashes[name] = hash;
  return hashes;
}

class Stored : public testing::TestWithParam<TruthScene> {};

TEST_P(Stored, Image) {
  const std::string name(GetParam().name);
  const Scene scene = GetParam().make();
  const auto hashes = stored_hashes();
  ASSERT_TRUE(hashes.contains(name)) << "not in hashes.txt: run ./dev truth";
  EXPECT_EQ(content_hash(scene), hashes.at(name)) << "the scene has changed since its image was stored: run ./dev truth";

  const HostImage image = read_image(folder + name + ".pfm");
  ASSERT_EQ(image.extent, stored_extent);
  ASSERT_EQ(image.channels, 3);
  const double mean = std::accumulate(image.values.begin(), image.values.end(), 0.0) / static_cast<double>(image.values.size());
  ASSERT_FALSE(!(mean > 0));

  const Reference reference(scene, stored_settings);
  std::mt19937 random(20240229);
  double worst = 0;
  for (int k = 0; k < 200; ++k) {
    const int x = static_cast<int>(random() % static_cast<unsigned>(stored_extent.width));
    const int y = static_cast<int>(random() % static_cast<unsigned>(stored_extent.height));
    const glm::dvec3 value = reference.pixel(glm::dvec2(x + 0.5, y + 0.5), stored_extent).beauty();
    for (int c = 0; c < 3; ++c) {
      const double rounding = 0x1p-24 * std::fabs(value[c]);  // of the stored float
      const double error = (std::fabs(value[c] - static_cast<double>(image.at(x, y, c))) - rounding) / mean;
      EXPECT_FALSE(!(error <= tolerance("truth_stored")))
          << "pixel " << x << ", " << y << ": " << value[c] << " is stored as " << image.at(x, y, c);
      worst = std::max(worst, error);
    }
  }
  std::printf("%s: 200 pixels, largest difference %.2g of the mean %.3g beyond rounding\n", name.c_str(), worst, mean);
}

INSTANTIATE_TEST_SUITE_P(Truth, Stored, testing::ValuesIn(stored_scenes().begin(), stored_scenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

// Every stored hash belongs to a scene.
TEST(StoredScenes, NoneLeftOver) {
  std::set<std::string> names, stored;
  for (const TruthScene& scene : stored_scenes()) names.emplace(scene.name);
  for (const auto& [name, hash] : stored_hashes()) stored.insert(name);
  EXPECT_EQ(stored, names);
}

// A scene that differs in one value has another hash.
TEST(StoredScenes, HashSeesValuesAndMeshes) {
  const Scene scene = gaussians_behind_box();
  const std::string hash = content_hash(scene);
  EXPECT_EQ(content_hash(gaussians_behind_box()), hash);
  Scene other = scene;
  other.medium.gaussians[1].center.z = std::nextafter(other.medium.gaussians[1].center.z, 0.0);
  EXPECT_NE(content_hash(other), hash);
  other = scene;
  Mesh mesh = *scene.surfaces[0].mesh;
  mesh.positions.back().x = std::nextafter(mesh.positions.back().x, 9.0F);
  other.surfaces[0].mesh = std::make_shared<const Mesh>(mesh);
  EXPECT_NE(content_hash(other), hash);
}

}  // namespace
}  // namespace airlight
