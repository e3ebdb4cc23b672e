// Techniques on both backends against the reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <glm/ext/matrix_transform.hpp>
#include <string>
#include <thread>
#include <vector>

#include "app/airlight.h"
#include "common/reference/reference.h"
#include "tests/tolerances.h"
#include "tests/truth/gaussian_scenes.h"
#include "tests/truth/relative_error.h"
#include "tests/truth/scenes.h"
#include "tests/truth/shadow_scenes.h"
#include "tests/truth/truth_scenes.h"

namespace airlight {
namespace {

constexpr Extent many_pixels{160, 120};
constexpr Extent few_pixels{96, 72};  // where many steps are taken, and edges are not what is asked about

class Techniques : public testing::TestWithParam<TruthScene> {};

double mean_of(const ReferenceFrame& truth, const Part& part) {
  double sum = 0;
  for (const ReferencePixel& p : truth.pixels) sum += part.of(p).x + part.of(p).y + part.of(p).z;
  return sum / (3 * static_cast<double>(truth.pixels.size()));
}

// Names of tolerances.
struct Bounds {
  std::string_view off_edges, surface_off_edges, everywhere, airlight_everywhere;
};

// Both backends against the truth. Parts darker than `least` of beauty are left out.
void hold(const Scene& scene, Extent extent, const RenderSettings& asked, const ReferenceFrame& truth, const Bounds& bounds,
          double least) {
  for (const char* backend : {"cpu", "gl"}) {
    Renderer renderer({.backend = backend});
    RenderSettings settings = asked;
    settings.resolution = extent;
    settings.images = {"beauty", "surface", "airlight"};
    const Frame frame = renderer.render(scene, settings);
    for (const Part& part : parts) {
      if (mean_of(truth, part) < least * mean_of(truth, parts[0])) continue;
      const HostImage& image = frame.image(part.name);
      EXPECT_EQ(image.extent, extent);
      EXPECT_EQ(image.channels, 3);
      const RelativeError error = relative_error(image, truth, part);
      std::printf("%-3s %-8s relative RMSE %.5f %% off edges, %.5f %% everywhere\n", backend, std::string(part.name).c_str(),
                  100 * error.off_edges, 100 * error.everywhere);
      const std::string_view bound = part.name == "surface" ? bounds.surface_off_edges : bounds.off_edges;
      EXPECT_FALSE(!(error.off_edges < tolerance(bound))) << backend << ' ' << part.name;
      if (part.name != "surface") {  // which a single pixel at an edge can be all of
        EXPECT_FALSE(!(error.everywhere < tolerance(bounds.everywhere))) << backend << ' ' << part.name;
      }
      if (part.name == "airlight") {
        EXPECT_FALSE(!(error.everywhere < tolerance(bounds.airlight_everywhere))) << backend;
      }
      const auto negative = std::count_if(image.values.begin(), image.values.end(), [](float v) { return !(v >= 0); });
      EXPECT_EQ(negative, 0) << backend << ' ' << part.name;
    }
  }
}

ReferenceFrame truth_of(const Scene& scene, Extent extent) {
  NoProgress progress;
  const int threads = static_cast<int>(std::thread::hardware_concurrency());
  ReferenceFrame truth = reference_frame(scene, extent, {1e-7, true, Indirect::unbounded}, true, threads, progress);
  const double share = truth.edge_share();
  std::printf("%dx%d, %.2f %% of the pixels at edges, truth claims %.1e\n", extent.width, extent.height, 100 * share,
              truth.error);
  EXPECT_FALSE(!(share <= tolerance("truth_edge_share")));
  EXPECT_FALSE(!(truth.error <= 1e-5));
  return truth;
}

TEST_P(Techniques, ShadowPlanes) {
  const Scene scene = GetParam().make();
  RenderSettings settings;
  settings.technique = "shadow-planes";
  hold(scene, many_pixels, settings, truth_of(scene, many_pixels),
       {"truth_off_edges", "truth_surface_off_edges", "truth_everywhere", "truth_airlight_everywhere"}, 0);
}

INSTANTIATE_TEST_SUITE_P(Truth, Techniques, testing::ValuesIn(homogeneous_scenes().begin(), homogeneous_scenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });
INSTANTIATE_TEST_SUITE_P(Shadows, Techniques, testing::ValuesIn(shadow_scenes().begin(), shadow_scenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

class Marching : public testing::TestWithParam<TruthScene> {};

// By default; and eight times the steps leave less than a third of the error, or as little as closed forms in single precision
// do: how it falls from one to the next depends on how steps lie to lamps.
TEST_P(Marching, ConvergesToTheTruth) {
  const Scene scene = GetParam().make();
  const ReferenceFrame truth = truth_of(scene, few_pixels);
  RenderSettings settings;
  settings.technique = "marching";
  if (GetParam().name == "dense_fog") settings.knobs = {{"steps", "512"}};
  if (GetParam().name == "box_in_blob") settings.knobs = {{"steps", "128"}};  // a lamp in a Gaussian of half a metre, 60 m of ray
  hold(scene, few_pixels, settings, truth, {"truth_marching", "truth_marching", "truth_marching", "truth_marching"}, 1e-9);
  if (scene.medium.grid || !scene.medium.gaussians.empty()) {
    std::printf("opacity-propagation\n");
    RenderSettings propagation;
    propagation.technique = "opacity-propagation";
    if (GetParam().name == "box_in_blob") propagation.knobs = {{"steps", "128"}};
    hold(scene, few_pixels, propagation, truth,
         {"truth_propagation", "truth_propagation", "truth_propagation", "truth_propagation"}, 1e-9);
  }
  Renderer renderer({.backend = "cpu"});
  settings.resolution = few_pixels;
  std::vector<double> errors;
  for (const char* steps : {"16", "32", "64", "128"}) {
    settings.knobs = {{"steps", steps}, {"light_steps", steps}};
    const Frame frame = renderer.render(scene, settings);
    errors.push_back(relative_error(frame.image("beauty"), truth, parts[0]).off_edges);
    std::printf("cpu beauty, %s steps: relative RMSE %.5f %%\n", steps, 100 * errors.back());
  }
  EXPECT_FALSE(!(errors.back() < std::max(errors.front() / 3, tolerance("truth_off_edges"))));
}

std::vector<TruthScene> marching_scenes() {
  std::vector<TruthScene> all(stored_scenes().begin(), stored_scenes().end());
  for (const TruthScene& scene : gaussian_scenes()) {
    for (const std::string_view name : {"lamp_in_gaussians", "shafts_through_blobs", "box_in_blob"}) {
      if (scene.name == name) all.push_back(scene);
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Truth, Marching, testing::ValuesIn(marching_scenes()),
                         [](const auto& test) { return std::string(test.param.name); });

// The camera stands in what hides nearly all that is behind: of a long way through the medium only the first metres are seen, and
// lamps there.
Scene about_the_camera(std::string_view what) {
  Scene scene = foggy_scene(what == "fog" || what == "wide_in_fog" ? 0.06 : 0);
  scene.camera = {.position = {0, 0, 0}, .look_at = {0, 0, -1}, .vertical_fov = 50};
  scene.medium.phase = {PhaseKind::henyey_greenstein, scene.medium.extinction > 0 ? 0.9 : 0.6};
  scene.lights = {point_light({0.5, 0.7, -3}, {10, 9, 8}), point_light({-1, 0.2, 2}, {8, 9, 10})};
  if (what == "gaussian") {
    scene.medium.gaussians = {{.center = {0, 0, -5}, .radius = 20, .extinction = 1, .albedo = {0.9, 0.8, 0.7}}};
  } else if (what == "wide_in_fog") {
    scene.medium.gaussians = {{.center = {300, 0, -900}, .radius = 1000, .extinction = 0.002}};
  } else if (what == "grid") {
    VoxelGrid cells{{6, 5, 5}, {}};
    for (int i = 0; i < 150; ++i) cells.values.push_back(i % 2 == 0 ? 1.0F : 0.8F);
    GridMedium grid;
    grid.transform = glm::translate(glm::dmat4(1), {-30, -22, -40}) * glm::scale(glm::dmat4(1), glm::dvec3(10));
    grid.voxels = std::make_shared<const VoxelGrid>(std::move(cells));
    scene.medium.grid = grid;
  }
  return scene;
}

class AboutTheCamera : public testing::TestWithParam<const char*> {};

TEST_P(AboutTheCamera, IsSeenAsItIs) {
  const Scene scene = about_the_camera(GetParam());
  const ReferenceFrame truth = truth_of(scene, few_pixels);
  for (const char* technique : {"marching", "opacity-propagation"}) {
    std::printf("%s\n", technique);
    RenderSettings settings;
    settings.technique = technique;
    const std::string_view bound = technique == std::string_view("marching") ? "truth_marching" : "truth_propagation";
    hold(scene, few_pixels, settings, truth, {bound, bound, bound, bound}, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Truth, AboutTheCamera, testing::Values("fog", "gaussian", "wide_in_fog", "grid"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace airlight
