// A band of rows has the bits that it has in the whole image: of every technique, on both backends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "app/airlight.h"
#include "common/plan/rows.h"

namespace airlight {

namespace {

// Fog, steam, two lights and a caster; tall, so that it has several rows of tiles, and of samples.
Scene tall_scene() {
  Scene scene;
  scene.camera.position = {0, 0, 4};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.vertical_fov = 60;
  scene.camera.resolution = {24, 330};
  scene.medium.extinction = 0.1;
  for (const double y : {-1.2, 0.1, 1.3}) {
    Gaussian blob;
    blob.center = {0.1 * y, y, 0.2};
    blob.radius = 0.5;
    blob.extinction = 1.5;
    scene.medium.gaussians.push_back(blob);
  }
  LightSource lamp, sun;
  lamp.name = "lamp";
  lamp.position = {0.3, 0.8, 0.6};
  lamp.power = {9, 5, 2};
  sun.type = LightType::directional;
  sun.direction = {0, -1, 0};
  sun.power = {0.5, 0.5, 0.7};
  scene.lights = {lamp, sun};
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{-0.4, -1, 0}, {0.5, -0.9, 0.3}, {0, 1.7, -0.2}, {-0.3, 0.2, 0.4}};
  mesh->normals.assign(4, {0, 0, 1});
  mesh->triangles = {{0, 1, 2}, {3, 1, 2}};
  Surface surface;
  surface.mesh = mesh;
  scene.surfaces = {surface};
  return scene;
}

struct Way {
  const char* name;
  const char* technique;
  std::vector<std::pair<std::string, std::string>> knobs;
  std::vector<std::string> images = {"beauty", "depth", "airlight.lamp", "optical_depth"};
  int supersample = 1;
  int height = 330;
  bool on_gl = true;
};
void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

std::vector<Way> ways() {
  return {
      {"fog", "shadow-planes", {}, {"beauty", "depth", "surface.direct", "normal"}},
      {"fog_supersampled", "shadow-planes", {}, {"beauty", "depth"}, 2, 150, false},
      {"fog_in_slabs", "shadow-planes", {}, {"beauty", "depth"}, 1, 1100},  // of GL
      {"published_shadows", "shadow-planes", {{"shadows", "published"}}, {"beauty"}, 1, 150, false},
      {"gaussians", "gaussian-airlight", {}, {"beauty", "depth", "airlight.lamp"}, 1, 330, false},
      {"gaussians_sampled", "gaussian-airlight", {{"airlight_resolution", "quarter"}}},
      {"gaussians_projected",
       "gaussian-airlight",
       {{"light_path", "published"}, {"shadows", "off"}},
       {"beauty", "optical_depth"}},
      {"marching", "marching", {{"steps", "8"}}, {"beauty", "airlight", "optical_depth"}, 1, 150, false},
      {"propagation_sampled", "opacity-propagation", {{"airlight_resolution", "half"}, {"resolution", "16"}}, {"beauty"}},
      {"network", "illumination-network", {{"particles", "64"}, {"directions", "16"}}, {"beauty", "depth"}, 1, 150, false},
      {"splats", "illumination-network", {{"particles", "64"}, {"directions", "16"}, {"image", "splats"}}, {"beauty"}},
      {"reference", "reference", {}, {"beauty", "depth", "standard_error"}, 1, 20, false},
  };
}

Scene scene_for(const Way& way) {
  Scene scene = tall_scene();
  scene.camera.resolution.height = way.height;
  if (std::string(way.technique) == "shadow-planes") scene.medium.gaussians.clear();
  return scene;
}

RenderSettings settings_for(const Way& way) {
  RenderSettings settings;
  settings.technique = way.technique;
  settings.knobs = way.knobs;
  settings.images = way.images;
  settings.supersample = way.supersample;
  return settings;
}

// How many floats of the band differ from those of the whole image.
std::size_t different(const Frame& whole, const Frame& band, Rows rows) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < whole.images.size(); ++i) {
    const HostImage &all = whole.images[i].image, &some = band.images[i].image;
    EXPECT_EQ(some.extent, (Extent{all.extent.width, rows.count()}));
    const float* expected = all.values.data() + all.index(0, rows.first);
    for (std::size_t k = 0; k < some.values.size(); ++k) n += !(some.values[k] == expected[k]);
  }
  return n;
}

class Bands : public testing::TestWithParam<std::tuple<std::string, Way>> {};

TEST_P(Bands, HaveTheBitsOfTheWholeImage) {
  const auto& [backend, way] = GetParam();
  const Scene scene = scene_for(way);
  RenderSettings settings = settings_for(way);
  Renderer renderer({.backend = backend, .gl_context = "osmesa"});
  const Frame whole = renderer.render(scene, settings);
  // At tiles' borders and not, the last of one row; by a renderer that has the whole image, and by one that has nothing.
  const int h = way.height;
  for (const Rows rows : {Rows{0, h / 5}, Rows{h / 5, h / 2}, Rows{h / 2 + 5, h - 1}, Rows{h - 1, h}}) {
    settings.rows = rows;
    EXPECT_EQ(different(whole, renderer.render(scene, settings), rows), 0U) << rows.first << " to " << rows.end;
  }
  // Where tiles of samples begin, too: of every second row and of every fourth one.
  for (const Rows rows : {Rows{128, 165}, Rows{256, 300}}) {
    if (rows.end > h) continue;
    if (backend == "cpu") renderer = Renderer({.backend = backend});  // on GL making shaders takes too long
    settings.rows = rows;
    const Frame band = renderer.render(scene, settings);
    EXPECT_EQ(different(whole, band, rows), 0U) << rows.first << " to " << rows.end;
    // It is not the whole image that was made.
    for (const StepStats& step : band.stats.steps) {
      if (step.name != "compose") continue;
      EXPECT_LE(step.items, 24U * 64);
    }
  }
}

std::vector<std::tuple<std::string, Way>> cases() {
  std::vector<std::tuple<std::string, Way>> all;
  for (const Way& way : ways()) {
    all.emplace_back("cpu", way);
    if (way.on_gl) all.emplace_back("gl", way);
  }
  return all;
}

std::string name_of_case(const testing::TestParamInfo<std::tuple<std::string, Way>>& info) {
  return std::get<0>(info.param) + "_" + std::get<1>(info.param).name;
}

INSTANTIATE_TEST_SUITE_P(All, Bands, testing::ValuesIn(cases()), name_of_case);

// Drawn slab by slab, GL sees what the CPU sees, but for single pixels at edges.
TEST(Slabs, FitTogether) {
  Scene scene = tall_scene();
  scene.medium.gaussians.clear();
  RenderSettings settings;
  settings.images = {"depth"};
  settings.resolution = Extent{24, 2100};
  Renderer cpu({.backend = "cpu"}), gl({.backend = "gl", .gl_context = "osmesa"});
  const Frame expected = cpu.render(scene, settings), found = gl.render(scene, settings);
  const std::vector<float>&a = expected.images[0].image.values, &b = found.images[0].image.values;
  std::size_t different = 0, surface = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    different += !(std::abs(a[i] - b[i]) <= 1e-4F * a[i]);
    surface += a[i] < 1e30F;
  }
  std::printf("%zu of %zu pixels differ\n", different, a.size());
  EXPECT_GT(surface, a.size() / 20);
  EXPECT_LE(different, 10U);
}

TEST(BandsOf, CoverTheImageOnce) {
  for (const int height : {1, 63, 64, 65, 600, 16384, 65535}) {
    for (const int count : {1, 2, 3, 7, 64, 1024}) {
      if (count > height) continue;
      int at = 0;
      for (int k = 1; k <= count; ++k) {
        const Rows band = band_of(k, count, height);
        EXPECT_EQ(band.first, at);
        EXPECT_GT(band.count(), 0) << k << " of " << count << " of " << height;
        at = band.end;
      }
      EXPECT_EQ(at, height);
    }
  }
  EXPECT_EQ(band_of(2, 3, 600), (Rows{192, 384}));
  EXPECT_EQ(band_of(3, 3, 600), (Rows{384, 600}));
}

}  // namespace

}  // namespace airlight
