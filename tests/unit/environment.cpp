// Environments: out of image files and scenes, and what is made of them once.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <set>

#include "app/airlight.h"
#include "common/error.h"
#include "common/plan/environment.h"
#include "common/scene/content_hash.h"
#include "common/scene/environment_file.h"
#include "common/scene/image_file.h"
#include "common/scene/load.h"
#include "tests/formulas/checks/sphere.h"
#include "tests/parity/inputs.h"
#include "tests/tolerances.h"
#include "tests/unit/scene_folder.h"

namespace airlight {
namespace {

constexpr double pi = std::numbers::pi;

HostImage random_image(Extent extent, int channels = 3) {
  HostImage image(extent, channels);
  for (std::uint32_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<float>(uniform(300, i));
  return image;
}

const std::string before = R"({ "airlight": 1, "lights": [ { "type": "environment", "file": ")";

class EnvironmentFiles : public testing::Test {
 protected:
  std::string write(const std::string& name, const HostImage& image) const {
    write_image(folder.file(name), image, {});
    return folder.file(name);
  }
  Scene load(const std::string& name, const std::string& more = "") const {
    return load_scene(folder.write("scene.json", before + name + "\"" + more + " } ] }"));
  }
  // One line at the file's value that names the file, and this of it.
  void expect_refused(const std::string& name, const std::string& part) const {
    std::string message;
    try {
      load(name);
    } catch (const InputError& e) {
      message = e.what();
    }
    std::cout << message << "\n";
    const std::string begin =
        folder.file("scene.json") + ":1:" + std::to_string(before.size()) + ": lights[0].file: " + folder.file(name) + ": ";
    EXPECT_EQ(message.substr(0, begin.size()), begin);
    EXPECT_NE(message.find(part), message.npos) << "expected in it: " << part;
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0);
  }
  Folder folder;
};

TEST_F(EnvironmentFiles, KeepTheirValues) {
  const HostImage image = random_image({8, 4});
  write("sky.exr", image);
  const Scene scene = load("sky.exr", R"(, "scale": 2.5, "rotation": -30)");
  ASSERT_TRUE(scene.environment && scene.environment->image);
  EXPECT_EQ(scene.environment->image->values, image.values);
  EXPECT_EQ(scene.environment->radiance, glm::dvec3(2.5));
  EXPECT_EQ(scene.environment->rotation, -30);
  EXPECT_TRUE(scene.lights.empty());
  // Radiance's shared exponent leaves eight bits.
  write("sky.hdr", image);
  const Scene coarse = load("sky.hdr");
  for (std::size_t i = 0; i < image.values.size(); ++i)
    EXPECT_NEAR(coarse.environment->image->values[i], image.values[i], 1.0 / 128);
}

TEST_F(EnvironmentFiles, BadOnesAreRefused) {
  const auto with = [&](float value) {
    HostImage image = random_image({8, 4});
    image.at(5, 2, 1) = value;
    return image;
  };
  write("negative.exr", with(-0.5F));
  expect_refused("negative.exr", "-0.5 in channel G of the pixel in column 5, row 2, expected a finite number of at least 0");
  write("nan.exr", with(std::numeric_limits<float>::quiet_NaN()));
  expect_refused("nan.exr", "nan in channel G of the pixel in column 5, row 2");
  write("infinite.exr", with(std::numeric_limits<float>::infinity()));
  expect_refused("infinite.exr", "inf in channel G of the pixel in column 5, row 2");
  write("square.exr", random_image({8, 8}));
  expect_refused("square.exr", "8 x 8 pixels, expected twice as many columns as rows");
  write("small.exr", random_image({2, 1}));
  expect_refused("small.exr", "2 x 1 pixels");
  folder.write("wide.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4097 +X 8194\n");
  expect_refused("wide.hdr", "8194 x 4097 pixels, expected at most 8192 columns");
  write("grey.exr", random_image({8, 4}, 1));
  expect_refused("grey.exr", "no channel R, expected R, G and B");
  write("sky.png", random_image({8, 4}));
  expect_refused("sky.png", "expected an EXR or HDR file");
  expect_refused("absent.exr", "no such file");
  folder.write("text.exr", "no image at all");
  expect_refused("text.exr", "not a readable image");
  // Cut off in the middle of the pixels.
  for (const std::string name : {"whole.exr", "whole.hdr"}) {
    const std::string bytes = bytes_of(write(name, random_image({64, 32})));
    folder.write("cut" + name.substr(5), bytes.substr(0, bytes.size() / 2));
    expect_refused("cut" + name.substr(5), "reading failed");
  }
}

TEST_F(EnvironmentFiles, EveryByteAndValueChangesTheHash) {
  const std::string bytes = bytes_of(write("sky.exr", random_image({8, 4})));
  std::set<std::string> hashes, contents;
  const auto expect_new = [&](const Scene& scene) { EXPECT_TRUE(hashes.insert(scene.hash).second); };
  const Scene scene = load("sky.exr");
  contents.insert(content_hash(scene));
  expect_new(scene);
  expect_new(load("sky.exr", R"(, "scale": 2)"));
  expect_new(load("sky.exr", R"(, "rotation": 2)"));
  folder.write("sky.exr", bytes + " ");
  const Scene longer = load("sky.exr");
  expect_new(longer);
  EXPECT_FALSE(contents.insert(content_hash(longer)).second);
  write("sky.exr", random_image({16, 8}));
  const Scene other = load("sky.exr");
  expect_new(other);
  EXPECT_TRUE(contents.insert(content_hash(other)).second);
}

// The camera looks along -Z, the middle of the image; columns grow toward +X, rows from +Y down.
TEST(Environments, StandAsTheSceneSays) {
  auto image = std::make_shared<HostImage>(Extent{8, 4}, 3);
  const auto shown = [&](int column, int row, const glm::dvec3& look_at, double rotation) {
    for (float& v : image->values) v = 0;
    image->at(column, row, 0) = 1;
    Scene scene;
    scene.environment = {image, {2, 2, 2}, rotation};
    scene.camera.look_at = look_at, scene.camera.up = {0.3, 1, 0.2};
    RenderSettings settings;
    settings.resolution = Extent{1, 1};
    settings.images = {"beauty"};
    double value = 0;
    for (const char* technique : {"shadow-planes", "gaussian-airlight", "reference"}) {
      settings.technique = technique;
      Renderer renderer(RendererOptions{});
      const Frame frame = renderer.render(scene, settings);
      value = static_cast<double>(frame.image("beauty").at(0, 0, 0));
      std::printf("%s: %.7f\n", technique, value);
    }
    return value;
  };
  // The direction of the centre of that pixel.
  const auto center = [](int column, int row) {
    const double azimuth = 2 * pi * ((column + 0.5) / 8 - 0.5), polar = pi * (row + 0.5) / 4;
    return glm::dvec3(std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth));
  };
  EXPECT_NEAR(shown(5, 1, center(5, 1), 0), 2, 1e-5);
  EXPECT_NEAR(shown(0, 3, center(0, 3), 0), 2, 1e-5);
  EXPECT_NEAR(shown(4, 1, {0.1, 0.3, -1}, 0), shown(4, 1, {0.1, 0.3, -1}, 360), 1e-5);
  // A turn about +Y takes -Z toward -X: what stood in one column stands where the one before was.
  EXPECT_NEAR(shown(5, 1, center(4, 1), 45), 2, 1e-5);
  EXPECT_NEAR(shown(0, 1, center(7, 1), 45), 2, 1e-5);
}

// Each coefficient, by a finer sum over the sphere.
TEST(Environments, ProjectOntoHarmonics) {
  const auto image = std::make_shared<HostImage>(random_image({8, 4}));
  const Environment e{image, {1, 1, 1}, 77};
  const EnvironmentHarmonics h = environment_harmonics(e);
  std::array<double, 36> truth{};
  constexpr int columns = 720, rows = 360;
  for (int y = 0; y < rows; ++y) {
    const double polar = pi * (y + 0.5) / rows;
    for (int x = 0; x < columns; ++x) {
      const double turns = (x + 0.5) / columns, azimuth = 2 * pi * (turns - 0.5);
      const double column = (turns + e.rotation / 360) * 8 - 0.5, row = std::clamp((y + 0.5) / rows * 4 - 0.5, 0.0, 3.0);
      const int i = static_cast<int>(std::floor(column)), j = std::min(static_cast<int>(row), 2);
      const double u = column - i, v = row - j;
      const auto pixel = [&](int a, int b) { return static_cast<double>(image->at((a + 8) % 8, b, 1)); };
      const double value =
          (1 - v) * ((1 - u) * pixel(i, j) + u * pixel(i + 1, j)) + v * ((1 - u) * pixel(i, j + 1) + u * pixel(i + 1, j + 1));
      const double weight = (std::cos(pi * y / rows) - std::cos(pi * (y + 1) / rows)) * 2 * pi / columns * value;
      const glm::dvec3 d(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
      for (int k = 0; k < 36; ++k) truth[static_cast<std::size_t>(k)] += weight * harmonic(k, d);
    }
  }
  double worst = 0;
  for (std::size_t k = 0; k < 36; ++k) worst = std::max(worst, std::fabs(h[1][k] - truth[k]) / truth[0]);
  std::printf("coefficients at most %.2g of the first off\n", worst);
  EXPECT_FALSE(!(worst <= tolerance("environment_harmonics")));
}

}  // namespace
}  // namespace airlight
