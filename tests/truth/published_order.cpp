// Shadow planes sorted as wholes, as published, beside those sorted ray by ray: where they agree, and where the published order
// fails.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <thread>

#include "app/airlight.h"
#include "common/reference/reference.h"
#include "common/scene/load.h"
#include "tests/tolerances.h"
#include "tests/truth/relative_error.h"
#include "tests/truth/scenes.h"

namespace airlight {
namespace {

constexpr Extent extent{160, 120};

struct Errors {
  double exact = 0, published = 0;
};

class PublishedOrder : public testing::TestWithParam<std::string> {
 protected:
  // Of the airlight, off edges.
  Errors errors(const Scene& scene) {
    NoProgress progress;
    const int threads = static_cast<int>(std::thread::hardware_concurrency());
    const ReferenceFrame truth = reference_frame(scene, extent, {1e-7, true, Indirect::unbounded}, true, threads, progress);
    EXPECT_FALSE(!(truth.edge_share() <= tolerance("truth_edge_share")));
    const auto error = [&](const char* shadows) {
      RenderSettings settings;
      settings.technique = "shadow-planes";
      settings.resolution = extent;
      settings.images = {"airlight"};
      settings.knobs = {{"shadows", shadows}};
      const double e = relative_error(renderer.render(scene, settings).image("airlight"), truth, parts[2]).off_edges;
      std::printf("%-3s airlight, shadows=%-9s: relative RMSE %.5f %% off edges\n", GetParam().c_str(), shadows, 100 * e);
      return e;
    };
    return {error("on"), error("published")};
  }

  void agree(const Scene& scene) {
    const Errors e = errors(scene);
    EXPECT_FALSE(!(e.exact < tolerance("truth_off_edges")));
    EXPECT_FALSE(!(e.published < tolerance("truth_off_edges")));
  }
  void differ(const Scene& scene) {
    const Errors e = errors(scene);
    EXPECT_FALSE(!(e.exact < tolerance("truth_off_edges")));
    EXPECT_FALSE(!(e.published > tolerance("published_order") * tolerance("truth_off_edges")));
  }

  Renderer renderer{{.backend = GetParam()}};
};

// A box of no great length: of the planes that a ray crosses, the one that it leaves by lies behind the one it enters by as a
// whole.
Scene one_box(const LightSource& light) {
  Scene scene = foggy_scene(0.15);
  scene.camera = {.position = {2.2, 0.9, 3.4}, .look_at = {0, 0.9, 0}, .vertical_fov = 48};
  scene.sky_distance = 30;
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.3};
  scene.lights = {light};
  Mesh ground;
  add_parallelogram(ground, {-9, 0, 9}, {18, 0, 0}, {0, 0, -18});
  scene.surfaces = {surface(box({-0.5, 1.2, -0.4}, {0.5, 1.4, 0.4}), diffuse(0.4F, 0.3F, 0.2F), true),
                    surface(std::move(ground), diffuse(0.3F, 0.3F, 0.3F), true)};
  return scene;
}

Scene pergola() { return load_scene(AIRLIGHT_SCENES "/pergola.json"); }

const LightSource sun = directional_light({0.3, -1, -0.25}, {0.8, 0.75, 0.6});

TEST_P(PublishedOrder, IsRightForOneBoxUnderALamp) { agree(one_box(point_light({0.1, 2.4, -0.15}, {12, 10, 7}, 0.01))); }

TEST_P(PublishedOrder, IsRightForOneBoxUnderTheSun) { agree(one_box(sun)); }

TEST_P(PublishedOrder, IsRightWhereTheCameraStandsInTheShadowOfTheBox) {
  Scene scene = one_box(point_light({0.1, 2.4, -0.15}, {12, 10, 7}, 0.01));
  scene.camera.position = {0.3, 0.5, 0.33};
  scene.camera.look_at = {0.1, 0.4, -3};
  agree(scene);
}

TEST_P(PublishedOrder, IsWrongWherePlanesOfALampInterleave) { differ(pergola()); }

TEST_P(PublishedOrder, IsWrongWherePlanesOfTheSunInterleave) {
  Scene scene = pergola();
  scene.lights = {sun};
  differ(scene);
}

INSTANTIATE_TEST_SUITE_P(Backends, PublishedOrder, testing::Values("cpu", "gl"), [](const auto& p) { return p.param; });

}  // namespace
}  // namespace airlight
