#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "common/error.h"
#include "common/scene/load.h"
#include "tests/unit/scene_folder.h"

namespace airlight {
namespace {

Scene parsed(const std::string& text) {
  NoProgress none;
  return parse_scene(text, "scene.json", AIRLIGHT_TEST_DATA "/broken", none);
}

TEST(SceneLoad, AnEmptySceneHasTheDefaults) {
  const Scene s = parsed(R"({ "airlight": 1 })");
  EXPECT_EQ(s.camera.position, glm::dvec3(0, 0, 0));
  EXPECT_EQ(s.camera.look_at, glm::dvec3(0, 0, -1));
  EXPECT_EQ(s.camera.up, glm::dvec3(0, 1, 0));
  EXPECT_EQ(s.camera.vertical_fov, 45);
  EXPECT_EQ(s.camera.resolution, (Extent{800, 600}));
  EXPECT_TRUE(std::isinf(s.sky_distance));
  EXPECT_TRUE(s.medium.empty());
  EXPECT_EQ(s.medium.phase.kind, PhaseKind::isotropic);
  EXPECT_EQ(s.medium.albedo, glm::dvec3(1));
  EXPECT_TRUE(s.lights.empty() && s.surfaces.empty() && s.technique.empty() && s.settings.empty());
  EXPECT_EQ(s.hash.size(), 64U);
}

TEST(SceneLoad, EveryKeyArrives) {
  const Scene s = parsed(R"({
    "airlight": 1,  // comments of both kinds
    "camera": { "position": [1, 2, 3], "look_at": [4, 5, 6], "up": [0, 0, 2], "vertical_fov": 30.5, "resolution": [65535, 1] },
    "sky_distance": 7.5, /* "sky_distance": 8, */
    "medium": { "phase": { "type": "cornette_shanks", "g": -0.99 }, "albedo": [0, 0.5, 1], "ambient": [0.1, 0.2, 0.3],
      "emission": [1, 2, 3], "homogeneous": { "visibility": 78.24 },
      "gaussians": [ { "center": [1, 2, 3], "radius": 0.5, "extinction": 2 },
                     { "center": [4, 5, 6], "radius": 1e-6, "extinction": 0, "albedo": [0.5, 0.25, 0], "emission": [9, 8, 7] } ] },
    "lights": [ { "type": "point", "name": "Lämpchen", "position": [1, 2, 3], "intensity": [4, 5, 6], "radius": 0.25 },
                { "type": "directional", "direction": [0, -3, 4], "irradiance": [7, 8, 9] } ],
    "surfaces": [ { "mesh": "quad.obj", "translate": [10, 20, 30], "rotate": [0, 90, 0], "scale": [2, 3, 4], "casts_shadow": false,
                    "material": { "diffuse": [0.1, 0.2, 0.3], "specular": [0.4, 0.5, 0.6], "shininess": 70 } },
                  { "mesh": "quad.obj" } ],
    "background": [0.5, 0.25, 0.125],
    "technique": { "samples": 4, "name": "gaussian-airlight", "exact": true, "scale": 0.1, "erf": "fast" }
  })");
  EXPECT_EQ(s.camera.position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(s.camera.look_at, glm::dvec3(4, 5, 6));
  EXPECT_EQ(s.camera.up, glm::dvec3(0, 0, 2));
  EXPECT_EQ(s.camera.vertical_fov, 30.5);
  EXPECT_EQ(s.camera.resolution, (Extent{65535, 1}));
  EXPECT_EQ(s.sky_distance, 7.5);
  EXPECT_EQ(s.medium.phase.kind, PhaseKind::cornette_shanks);
  EXPECT_EQ(s.medium.phase.g, -0.99);
  EXPECT_EQ(s.medium.albedo, glm::dvec3(0, 0.5, 1));
  EXPECT_EQ(s.medium.ambient, glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(s.medium.emission, glm::dvec3(1, 2, 3));
  EXPECT_EQ(s.medium.extinction, 3.912 / 78.24);
  ASSERT_EQ(s.medium.gaussians.size(), 2U);
  EXPECT_EQ(s.medium.gaussians[0].center, glm::dvec3(1, 2, 3));
  EXPECT_EQ(s.medium.gaussians[0].radius, 0.5);
  EXPECT_EQ(s.medium.gaussians[0].extinction, 2);
  EXPECT_EQ(s.medium.gaussians[0].albedo, s.medium.albedo);
  EXPECT_EQ(s.medium.gaussians[0].emission, s.medium.emission);
  EXPECT_EQ(s.medium.gaussians[1].albedo, glm::dvec3(0.5, 0.25, 0));
  EXPECT_EQ(s.medium.gaussians[1].emission, glm::dvec3(9, 8, 7));
  ASSERT_EQ(s.lights.size(), 2U);
  EXPECT_EQ(s.lights[0].type, LightType::point);
  EXPECT_EQ(s.lights[0].name, "Lämpchen");
  EXPECT_EQ(s.lights[0].position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(s.lights[0].power, glm::dvec3(4, 5, 6));
  EXPECT_EQ(s.lights[0].radius, 0.25);
  EXPECT_EQ(s.lights[1].type, LightType::directional);
  EXPECT_LT(glm::length(s.lights[1].direction - glm::dvec3(0, -0.6, 0.8)), 1e-15);
  EXPECT_EQ(s.lights[1].power, glm::dvec3(7, 8, 9));
  ASSERT_EQ(s.surfaces.size(), 2U);
  EXPECT_EQ(s.surfaces[0].mesh, s.surfaces[1].mesh) << "one file is one mesh";
  EXPECT_FALSE(s.surfaces[0].casts_shadow);
  EXPECT_TRUE(s.surfaces[1].casts_shadow);
  EXPECT_EQ(s.surfaces[0].material.diffuse, glm::vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(s.surfaces[0].material.specular, glm::vec3(0.4F, 0.5F, 0.6F));
  EXPECT_EQ(s.surfaces[0].material.shininess, 70);
  EXPECT_EQ(s.surfaces[1].transform, glm::dmat4(1));
  // Scale, then a quarter turn about +Y (x to -z, z to x), then the shift.
  EXPECT_EQ(s.surfaces[0].transform * glm::dvec4(1, 1, 1, 1), glm::dvec4(14, 23, 28, 1));
  EXPECT_EQ(s.background, glm::dvec3(0.5, 0.25, 0.125));
  EXPECT_EQ(s.technique, "gaussian-airlight");
  const std::vector<std::pair<std::string, std::string>> settings{
      {"samples", "4"}, {"exact", "true"}, {"scale", "0.1"}, {"erf", "fast"}};
  EXPECT_EQ(s.settings, settings);
}

TEST(SceneLoad, RotationsTurnAboutXThenYThenZ) {
  const auto turned = [](const std::string& angles, glm::dvec3 v) {
    const Scene s = parsed(R"({ "airlight": 1, "surfaces": [ { "mesh": "quad.obj", "rotate": )" + angles + " } ] }");
    return glm::dvec3(s.surfaces[0].transform * glm::dvec4(v, 0));
  };
  EXPECT_EQ(turned("[90, 0, 0]", {0, 1, 0}), glm::dvec3(0, 0, 1));
  EXPECT_EQ(turned("[0, 90, 0]", {0, 0, 1}), glm::dvec3(1, 0, 0));
  EXPECT_EQ(turned("[0, 0, -270]", {1, 0, 0}), glm::dvec3(0, 1, 0));
  EXPECT_EQ(turned("[180, 0, 0]", {0, 1, 0}), glm::dvec3(0, -1, 0));
  EXPECT_EQ(turned("[90, 0, 90]", {0, 1, 0}), glm::dvec3(0, 0, 1));
  const double error = glm::length(turned("[0, 0, 30]", {1, 0, 0}) - glm::dvec3(std::sqrt(0.75), 0.5, 0));
  std::cout << "error of 30 degrees " << error << "\n";
  EXPECT_TRUE(error <= 2e-16);
}

TEST(SceneLoad, PathsWithBlanksAndLettersBeyondAscii) {
  const Folder folder("mein Ordner mit Umläuten äöü 霧");
  folder.write("ein Häschen 霧.obj", square_obj);
  const Scene s =
      load_scene(folder.write("Nebel ü.json", R"({ "airlight": 1, "surfaces": [ { "mesh": "ein Häschen 霧.obj" } ] })"));
  EXPECT_EQ(s.surfaces.at(0).mesh->triangles.size(), 2U);
  const std::string missing = folder.file("nicht da.json");
  try {
    load_scene(missing);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()), missing + ": no such file");
  }
}

// Under a locale whose decimal sign is a comma.
TEST(SceneLoad, TheLocaleChangesNothing) {
  const Folder folder("locale");
  const std::string made = "localedef -i de_DE -f UTF-8 '" + folder.file("de_DE.UTF-8") + "' >/dev/null 2>&1";
  const std::string before = setlocale(LC_ALL, nullptr);
  bool comma = setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
  if (!comma && std::system(made.c_str()) == 0) {
    setenv("LOCPATH", folder.path().c_str(), 1);
    comma = setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
    unsetenv("LOCPATH");
  }
  if (!comma || localeconv()->decimal_point[0] != ',') {
    setlocale(LC_ALL, before.c_str());
    GTEST_SKIP() << "skipped: no locale with a decimal comma, and localedef cannot make one";
  }
  folder.write("half.obj", "v 0.5 0 0\nv 1.25 0 0\nv 1 1.75 0\nf 1 2 3\n");
  const std::string text = R"({ "airlight": 1, "sky_distance": 2.5, "surfaces": [ { "mesh": "half.obj" } ],
    "technique": { "name": "auto", "scale": 0.25 } })";
  const Scene there = load_scene(folder.write("scene.json", text));
  std::string message;
  try {
    parsed(R"({ "airlight": 1, "medium": { "albedo": [1.5, 0, 0] } })");
  } catch (const InputError& e) {
    message = e.what();
  }
  setlocale(LC_ALL, before.c_str());
  const Scene here = load_scene(folder.file("scene.json"));
  EXPECT_EQ(there.sky_distance, 2.5);
  EXPECT_EQ(there.settings.at(0).second, "0.25");
  EXPECT_EQ(there.surfaces.at(0).mesh->positions.at(0), glm::vec3(0.5F, 0, 0));
  EXPECT_EQ(there.surfaces.at(0).mesh->positions.at(2), glm::vec3(1, 1.75F, 0));
  EXPECT_EQ(there.hash, here.hash);
  EXPECT_EQ(message, "scene.json:1:41: medium.albedo[0]: 1.5, expected a number >= 0 and <= 1");
}

class Stopping final : public Progress {
 public:
  void report(std::string_view, double) override {}
  bool stop_requested() const override { return true; }
};

TEST(SceneLoad, StopsWhenAsked) {
  Stopping stop;
  EXPECT_THROW(load_mesh(AIRLIGHT_TEST_DATA "/broken/quad.obj", false, stop), Interrupted);
}

}  // namespace
}  // namespace airlight
