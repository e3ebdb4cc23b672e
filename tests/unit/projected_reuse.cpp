// What of the published airlight is made again: depths from a light not where only the camera has moved, those from the camera
// not where only lights have; and images have the same bits as in a cold render.
#include <gtest/gtest.h>

#include <ostream>

#include "app/airlight.h"
#include "common/techniques/technique.h"
#include "cpu/backend.h"

namespace airlight {
namespace {

struct Made {
  int bins = 0, to_camera = 0, to_light = 0, light_to_camera = 0;
  bool operator==(const Made&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Made& m) {
  return out << "bins " << m.bins << ", to camera " << m.to_camera << ", to lights " << m.to_light << ", lights to camera "
             << m.light_to_camera;
}

Scene lit_blobs() {
  Scene scene;
  scene.camera = {.position = {0, 0.5, 5}, .look_at = {0, 0, 0}};
  scene.camera.resolution = {48, 36};
  scene.sky_distance = 30;
  for (int i = 0; i < 6; ++i)
    scene.medium.gaussians.push_back({.center = {0.4 * i - 1, 0.1 * i, -0.2 * i}, .radius = 0.5, .extinction = 0.8});
  for (const glm::dvec3 position : {glm::dvec3(2, 1, 1), glm::dvec3(-2, 2, 0)}) {
    LightSource lamp;
    lamp.position = position;
    lamp.power = {10, 8, 6};
    scene.lights.push_back(lamp);
  }
  LightSource sun;
  sun.type = LightType::directional;
  sun.direction = {0, -1, 0};
  sun.power = {0.3, 0.3, 0.3};
  scene.lights.push_back(sun);
  return scene;
}

class ProjectedReuse : public testing::Test {
 protected:
  // What a backend has to be given, as the renderer does it.
  Made upload(const Scene& scene) {
    const Technique& t = technique("gaussian-airlight");
    FrameRequest request;
    request.extent = scene.camera.resolution;
    request.images = {"beauty"};
    const std::vector<std::pair<std::string, std::string>> knobs{{"light_path", "published"}};
    request.knobs = KnobValues(t.knobs, knobs);
    const Plan plan = t.plan(scene, request);
    const ProjectedGaussians* step = nullptr;
    for (const Step& s : plan.steps) {
      if (const auto* found = std::get_if<ProjectedGaussians>(&s.what)) step = found;
    }
    if (!step) throw std::logic_error("no such step");
    Made made;
    for (const Plan::Upload& u : plan.uploads) {
      if (backend_.holds(u.buffer, u.key)) continue;
      backend_.upload(u.buffer, u.make(), u.key);
      made.bins += u.buffer.id == step->bins.id;
      made.to_camera += u.buffer.id == step->to_camera.id;
      made.light_to_camera += u.buffer.id == step->light_to_camera.id;
      for (const Buffer& b : step->to_light) made.to_light += u.buffer.id == b.id;
    }
    // Images are those of a cold render.
    RenderSettings settings;
    settings.technique = "gaussian-airlight";
    settings.knobs = knobs;
    Renderer cold({.backend = "cpu"});
    EXPECT_EQ(warm_.render(scene, settings).image("beauty").values, cold.render(scene, settings).image("beauty").values);
    return made;
  }

 private:
  CpuBackend backend_{{}};
  Renderer warm_{{.backend = "cpu"}};
};

TEST_F(ProjectedReuse, OnlyWhatChangedIsMadeAgain) {
  Scene scene = lit_blobs();
  EXPECT_EQ(upload(scene), (Made{1, 1, 3, 1}));
  EXPECT_EQ(upload(scene), (Made{})) << "nothing changed";
  scene.camera.position.x += 0.3;
  EXPECT_EQ(upload(scene), (Made{1, 1, 0, 1})) << "the camera moved";
  scene.camera.look_at.y += 0.1;
  EXPECT_EQ(upload(scene), (Made{1, 0, 0, 0})) << "the camera turned";
  scene.lights[1].position.y += 0.2;
  EXPECT_EQ(upload(scene), (Made{0, 0, 1, 1})) << "a light moved";
  scene.lights[1].position = {0.4, 0.2, 0.3};
  upload(scene);
  scene.lights[1].position = {-2, 2.2, 0};
  EXPECT_EQ(upload(scene).to_camera, 0) << "a light left Gaussians, which have other reaches then";
  scene.lights[2].direction = {0.6, -0.8, 0};
  EXPECT_EQ(upload(scene), (Made{0, 0, 1, 1})) << "a directional light turned";
  scene.lights[0].power *= 2.0;
  EXPECT_EQ(upload(scene), (Made{})) << "a light is brighter";
  scene.medium.gaussians[1].albedo = {0.5, 0.5, 0.5};
  scene.medium.extinction = 0.05;
  EXPECT_EQ(upload(scene), (Made{})) << "albedo and fog are no depths of Gaussians";
  scene.medium.gaussians[2].extinction *= 1.5;
  EXPECT_EQ(upload(scene), (Made{1, 1, 3, 1})) << "the medium changed";
}

void expect_refused(const Scene& scene, const RenderSettings& settings, const std::string& why) {
  Renderer renderer({.backend = "cpu"});
  try {
    renderer.render(scene, settings);
    ADD_FAILURE() << why;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("setting light_path: published " + why), 0U) << error.what();
  }
}

// What it does not know is refused by name, not left out.
TEST(Published, RefusesShadowsNoiseAndFewPixels) {
  Scene scene = lit_blobs();
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{0, 0, -3}, {1, 0, -3}, {0, 0, -4}};
  mesh->normals.assign(3, {0, 1, 0});
  mesh->triangles = {{0, 1, 2}};
  scene.surfaces.emplace_back();
  scene.surfaces[0].mesh = mesh;
  RenderSettings settings;
  settings.technique = "gaussian-airlight";
  settings.knobs = {{"light_path", "published"}};
  Renderer renderer({.backend = "cpu"});
  expect_refused(scene, settings, "has no shadows");
  settings.knobs.emplace_back("shadows", "off");
  EXPECT_NO_THROW(renderer.render(scene, settings));
  settings.knobs.pop_back();
  scene.surfaces[0].casts_shadow = false;
  EXPECT_NO_THROW(renderer.render(scene, settings));
  settings.knobs.emplace_back("airlight_resolution", "half");
  expect_refused(scene, settings, "renders every pixel");
  settings.knobs.pop_back();
  scene.medium.noise.amplitude = 0.1;
  expect_refused(scene, settings, "bends no rays");
}

}  // namespace
}  // namespace airlight
