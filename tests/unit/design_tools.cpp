// The design tools place what they say they do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/design/scene_editor.h"
#include "common/design/screen.h"
#include "common/design/tools.h"
#include "common/error.h"
#include "common/formulas/double.h"
#include "tests/tolerances.h"

namespace airlight {
namespace {

Scene open_scene() {
  Scene s;
  s.camera.position = {1, 2, 8};
  s.camera.look_at = {0.5, 1, 0};
  s.camera.vertical_fov = 50;
  s.camera.resolution = {120, 80};
  return s;
}

// A cube from -1 to 1, seen from within and from without.
Surface cube() {
  auto mesh = std::make_shared<Mesh>();
  for (int i = 0; i < 8; ++i) mesh->positions.emplace_back((i & 1) * 2 - 1, (i >> 1 & 1) * 2 - 1, (i >> 2) * 2 - 1);
  const unsigned faces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    mesh->triangles.emplace_back(f[0], f[1], f[2]);
    mesh->triangles.emplace_back(f[0], f[2], f[3]);
  }
  mesh->normals.assign(8, {0, 1, 0});
  Surface surface;
  surface.mesh = mesh;
  return surface;
}

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

TEST(DesignScreen, IsThatOfThePicture) {
  const Scene scene = open_scene();
  for (const double fov : {0.01, 1.0, 50.0, 120.0, 179.0}) {
    Camera camera = scene.camera;
    camera.vertical_fov = fov;
    const Screen screen(camera);
    EXPECT_NEAR(screen.half_height() / std::tan(fov * M_PI / 360), 1, tolerance("design_screen")) << fov;
  }
  const Screen screen(scene.camera);
  const double width = 120, height = 80, tan_half = std::tan(25 * M_PI / 180);
  for (const auto& [i, j] : {std::pair{0.0, 0.0}, {60.0, 40.0}, {119.0, 3.0}, {17.0, 79.0}}) {
    const double x = f64::image_plane_x(i, 0, width, height, tan_half), y = f64::image_plane_y(j, 0, height, tan_half);
    const glm::dvec3 ray = glm::normalize(x * screen.right() + y * screen.up() + screen.forward());
    const glm::dvec2 at{(2 * (i + 0.5) - width) / height, 1 - 2 * (j + 0.5) / height};
    EXPECT_LT(glm::distance(screen.ray(at), ray), tolerance("design_screen"));
    const auto seen = screen.seen(scene.camera.position + 7.0 * ray);
    ASSERT_TRUE(seen);
    EXPECT_LT(glm::distance(seen->at, at), tolerance("design_screen"));
  }
  EXPECT_FALSE(screen.seen(scene.camera.position - screen.forward()));
  const DesignPlane floor{{0, -1, 0}, {0, 2, 0}};
  const auto below = screen.on_plane({0.1, -0.6}, floor);
  ASSERT_TRUE(below);
  EXPECT_NEAR(below->y, -1, tolerance("design_screen") * 10);
  EXPECT_LT(glm::distance(screen.seen(*below)->at, glm::dvec2(0.1, -0.6)), tolerance("design_screen"));
  EXPECT_FALSE(screen.on_plane({0, 0.9}, floor)) << "a ray into the sky";
}

TEST(DesignPaintbrush, SpacesGaussiansAlongTheStrokeAndMovesThemAcross) {
  const Scene scene = open_scene();
  const Screen screen(scene.camera);
  PaintEdit e;
  e.stroke.points = {{0, 0, 0}, {3, 0, 0}, {3, 0, 4}};
  e.puff = {0.5, 2.5, glm::dvec3(0.5), {}};
  const std::vector<Gaussian> made = painted(e, screen, scene.medium);
  const double spacing = 0.75 * 0.5;
  ASSERT_EQ(made.size(), static_cast<std::size_t>(7 / spacing) + 1);
  double farthest = 0, mean = 0;
  for (std::size_t i = 0; i < made.size(); ++i) {
    const double s = static_cast<double>(i) * spacing;
    const glm::dvec3 on_line = s <= 3 ? glm::dvec3(s, 0, 0) : glm::dvec3(3, 0, s - 3),
                     along = s <= 3 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 offset = made[i].center - on_line;
    EXPECT_LT(std::abs(glm::dot(offset, along)), tolerance("design_place")) << i;
    farthest = std::max(farthest, glm::length(offset));
    mean += glm::dot(offset, offset) / static_cast<double>(made.size());
    EXPECT_EQ(made[i].radius, 0.5);
    EXPECT_EQ(made[i].extinction, 2.5);
    EXPECT_EQ(made[i].albedo, glm::dvec3(0.5));
  }
  EXPECT_LT(farthest, 0.5) << "1 / a";
  EXPECT_NEAR(mean, 0.5 * 0.5 / 2, 0.06) << "uniform in a disk";

  e.scatter = 0, e.spacing = 1;
  const std::vector<Gaussian> still = painted(e, screen, scene.medium);
  ASSERT_EQ(still.size(), 8U);
  EXPECT_LT(glm::distance(still[5].center, glm::dvec3(3, 0, 2)), tolerance("design_place"));
  e.seed = 1;
  EXPECT_EQ(painted(e, screen, scene.medium)[4].center, still[4].center);
  e.scatter = 1;
  const glm::dvec3 one = painted(e, screen, scene.medium)[4].center;
  e.seed = 2;
  EXPECT_NE(painted(e, screen, scene.medium)[4].center, one);
}

TEST(DesignPaintbrush, ProjectsAStrokeOntoItsPlane) {
  const Scene scene = open_scene();
  const Screen screen(scene.camera);
  PaintEdit e;
  e.stroke.screen = {{-0.5, -0.5}, {0.4, -0.3}};
  e.stroke.plane = DesignPlane{{0, 0.5, 0}, {0, 1, 0}};
  e.scatter = 0;
  const std::vector<Gaussian> made = painted(e, screen, scene.medium);
  ASSERT_GT(made.size(), 3U);
  EXPECT_LT(glm::distance(screen.seen(made[0].center)->at, glm::dvec2(-0.5, -0.5)), tolerance("design_place"));
  for (const Gaussian& g : made) EXPECT_NEAR(g.center.y, 0.5, tolerance("design_place"));
  e.stroke.screen.resize(1);
  EXPECT_EQ(painted(e, screen, scene.medium).size(), 1U) << "a dot";
  e.stroke.screen = {{0, 0.9}};
  EXPECT_THROW(painted(e, screen, scene.medium), InputError);
  e.stroke.points = {{0, 0, 0}, {1e6, 0, 0}};
  e.stroke.screen.clear(), e.stroke.plane.reset();
  e.spacing = 1e-3;
  EXPECT_THROW(painted(e, screen, scene.medium), InputError) << "a billion of them";
}

TEST(DesignAirbrush, StaysWithinWhatIsClosed) {
  Scene scene = open_scene();
  AirbrushEdit e;
  e.points = {{0.5, 0.2, -0.1}};
  e.rate = 100, e.seconds = 3, e.spread = 4, e.diffusion = 0.5, e.bounce = 0.9;
  std::size_t out = 0;
  for (const Gaussian& g : airbrushed(e, Collisions(scene), scene.medium)) out += largest(g.center) > 1;
  EXPECT_GT(out, 150U) << "nothing holds them";
  scene.surfaces = {cube()};
  scene.surfaces[0].transform[3] = {100, 0, 0, 1};
  e.points[0].x += 100;
  const std::vector<Gaussian> held = airbrushed(e, Collisions(scene), scene.medium);
  ASSERT_EQ(held.size(), 300U);
  glm::dvec3 mean{0};
  for (const Gaussian& g : held) {
    EXPECT_LT(largest(g.center - glm::dvec3(100, 0, 0)), 1);
    mean += (g.center - glm::dvec3(100, 0, 0)) / 300.0;
  }
  EXPECT_LT(largest(mean), 0.2) << "spread evenly";
}

TEST(DesignAirbrush, ReflectsAsAMirrorDoes) {
  Scene scene = open_scene();
  scene.surfaces = {cube()};
  const Collisions surfaces(scene);
  AirbrushEdit e;
  e.points = {{0.25, 0, 0}};
  e.rate = 1, e.seconds = 1, e.velocity = {3.1, 1.7, 0.4}, e.drag = 0, e.diffusion = 0, e.bounce = 1;
  const std::vector<Gaussian> one = airbrushed(e, surfaces, scene.medium);
  ASSERT_EQ(one.size(), 1U);
  const auto folded = [](double x) {  // between mirrors at -1 and 1
    const double u = std::fmod(x + 1, 4);
    return u < 2 ? u - 1 : 3 - u;
  };
  const glm::dvec3 expected(folded(3.35), folded(1.7), folded(0.4));
  EXPECT_LT(glm::distance(one[0].center, expected), tolerance("design_bounce"));
  e.bounce = 0;  // it creeps along the wall
  EXPECT_GT(glm::distance(airbrushed(e, surfaces, scene.medium)[0].center, expected), 0.1);
}

TEST(DesignAirbrush, DiffusesAsFastAsItSays) {
  const Scene scene = open_scene();
  AirbrushEdit e;
  e.points = {{0, 0, 0}};
  e.rate = 1500, e.seconds = 2, e.diffusion = 0.3;
  const std::vector<Gaussian> made = airbrushed(e, Collisions(scene), scene.medium);
  glm::dvec3 variance{0};
  for (const Gaussian& g : made) variance += g.center * g.center / static_cast<double>(made.size());
  // Births are even in time: the mean of 2 D age is D seconds.
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(variance[k] / (0.3 * 2), 1, tolerance("design_diffusion")) << k;
  std::printf("[ measured ] variance of diffusion: %g %g %g of what it should be\n", variance.x / 0.6, variance.y / 0.6,
              variance.z / 0.6);
}

TEST(DesignEraser, TakesAwayAndRemoves) {
  const Scene scene = open_scene();
  const Screen screen(scene.camera);
  std::vector<Gaussian> all;
  for (int i = 0; i < 5; ++i) all.push_back({{i, 0, 0}, 1, 0.5 + i, {}, {}});
  EraseEdit e;
  e.stroke.points = {{0, 0.5, 0}, {2, 0.5, 0}};
  e.radius = 1, e.amount = 0.75;
  EXPECT_EQ(erase(e, screen, all), 3U);
  ASSERT_EQ(all.size(), 4U) << "the first had no more";
  EXPECT_EQ(all[0].extinction, 0.75);
  EXPECT_EQ(all[1].extinction, 1.75);
  EXPECT_EQ(all[2].extinction, 3.5) << "(3, 0, 0) is beyond the radius";

  // Along the view, whatever the depth: 0.2 m beside the ray, and behind the camera.
  const glm::dvec3 eye = scene.camera.position, ray = screen.ray({0.3, 0.1}), up = screen.up();
  std::vector<Gaussian> far{
      {eye + 3.0 * ray + 0.2 * up, 1, 1, {}, {}}, {eye + 90.0 * ray + 0.2 * up, 1, 1, {}, {}}, {eye - ray, 1, 1, {}, {}}};
  e.stroke = {};
  e.stroke.screen = {{0.3, 0.1}};
  e.radius = 0.19;
  EXPECT_EQ(erase(e, screen, far), 0U);
  e.radius = 0.21;
  EXPECT_EQ(erase(e, screen, far), 2U);
}

TEST(DesignEmitter, ThrowsParticlesThatShrink) {
  const Scene scene = open_scene();
  EmitEdit e;
  e.position = {1, 2, 3}, e.velocity = {0.5, 4, 0}, e.acceleration = {0, -2, 1};
  e.rate = 4, e.lifetime = 2, e.time = 3, e.puff = {0.8, 3, {}, {}};
  const std::vector<Gaussian> made = emitted(e, 0, scene.medium);
  ASSERT_EQ(made.size(), 8U) << "born after 1 s, when those of that second have just gone";
  for (std::size_t i = 0; i < made.size(); ++i) {
    const double age = 3 - (1.25 + 0.25 * static_cast<double>(i)), left = 1 - age / 2;
    EXPECT_LT(glm::distance(made[i].center, e.position + age * e.velocity + 0.5 * age * age * e.acceleration),
              tolerance("design_place"));
    EXPECT_NEAR(made[i].radius, 0.8 * left, tolerance("design_place"));
    EXPECT_NEAR(made[i].extinction, 3 * left, tolerance("design_place"));
  }
  e.spread = 0.1;
  for (const Gaussian& g : emitted(e, 0, scene.medium)) {
    const double age = (1 - g.radius / 0.8) * 2;
    EXPECT_LE(glm::distance(g.center, e.position + age * e.velocity + 0.5 * age * age * e.acceleration),
              0.1 * age + tolerance("design_place"));
  }
  // A particle keeps its path as time goes on.
  const Gaussian before = emitted(e, 0, scene.medium)[7], after = emitted(e, 0.5, scene.medium)[5];
  EXPECT_EQ(emitted(e, 0.5, scene.medium).size(), 8U);
  EXPECT_NEAR(before.radius - after.radius, 0.8 * 0.5 / 2, tolerance("design_place"));
}

TEST(DesignSelection, IsWhatIsSeenInTheRectangle) {
  Scene scene = open_scene();
  const Screen screen(scene.camera);
  const glm::dvec3 eye = scene.camera.position;
  for (const glm::dvec3& at : {eye + 4.0 * screen.ray({0.1, 0.1}), eye + 60.0 * screen.ray({0.39, -0.19}),
                               eye + 4.0 * screen.ray({0.41, 0}), eye - 4.0 * screen.ray({0.1, 0.1})}) {
    scene.medium.gaussians.push_back({at, 1, 1, {}, {}});
  }
  SceneEditor editor(scene);
  const ScreenRectangle r{{0.4, -0.2}, {0, 0.3}};
  editor.apply(CopyEdit{r});
  ASSERT_EQ(editor.copied().size(), 2U);
  EXPECT_EQ(editor.scene().medium.gaussians.size(), 4U);
  editor.apply(PasteEdit{{0, 0, 1}});
  ASSERT_EQ(editor.scene().medium.gaussians.size(), 6U);
  EXPECT_EQ(editor.scene().medium.gaussians[5].center, scene.medium.gaussians[1].center + glm::dvec3(0, 0, 1));
  editor.apply(UndoEdit{});
  editor.apply(MoveEdit{r, {0, 2, 0}});
  ASSERT_EQ(editor.scene().medium.gaussians.size(), 4U);
  EXPECT_EQ(editor.scene().medium.gaussians[0].center, scene.medium.gaussians[0].center + glm::dvec3(0, 2, 0));
  EXPECT_EQ(editor.scene().medium.gaussians[2].center, scene.medium.gaussians[2].center);
}

}  // namespace
}  // namespace airlight
