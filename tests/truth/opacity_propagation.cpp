// opacity-propagation against the reference where other tests of it do not go: dozens of lights, grids of a cell.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <thread>

#include "app/airlight.h"
#include "common/reference/reference.h"
#include "tests/tolerances.h"
#include "tests/truth/relative_error.h"
#include "tests/truth/scenes.h"

namespace airlight {
namespace {

// `on_gl`: cells along an edge there, where all volumes have to fit into one buffer, of 128 MiB on some drivers.
void hold(const Scene& scene, Extent extent, const char* on_gl = "64") {
  NoProgress progress;
  const int threads = static_cast<int>(std::thread::hardware_concurrency());
  const ReferenceFrame truth = reference_frame(scene, extent, {1e-5, true, Indirect::unbounded}, true, threads, progress);
  EXPECT_FALSE(!(truth.error <= 1e-4));
  for (const char* backend : {"cpu", "gl"}) {
    RenderSettings settings;
    settings.technique = "opacity-propagation";
    settings.resolution = extent;
    if (backend == std::string("gl")) settings.knobs = {{"resolution", on_gl}};
    settings.images = {"beauty", "airlight"};
    const Frame frame = Renderer({.backend = backend}).render(scene, settings);
    const double beauty = relative_error(frame.image("beauty"), truth, parts[0]).off_edges;
    const double airlight = relative_error(frame.image("airlight"), truth, parts[2]).off_edges;
    std::printf("%-3s relative RMSE %.4f %%, of the airlight alone %.4f %%\n", backend, 100 * beauty, 100 * airlight);
    EXPECT_FALSE(!(beauty < tolerance("truth_propagation"))) << backend;
    EXPECT_FALSE(!(airlight < tolerance("truth_propagation"))) << backend;
  }
}

// A ring of lamps of many colours about two blobs, and four suns.
TEST(OpacityPropagation, DozensOfLights) {
  Scene scene;
  scene.camera.position = {0, 1, 7};
  scene.camera.look_at = {0, 0, 0};
  scene.medium.gaussians = {{.center = {-0.6, 0, 0}, .radius = 0.8, .extinction = 0.9},
                            {.center = {0.7, 0.3, -0.4}, .radius = 0.6, .extinction = 1.2}};
  for (int i = 0; i < 28; ++i) {
    const double angle = 2 * std::numbers::pi * i / 28;
    scene.lights.push_back(point_light({2.6 * std::cos(angle), 0.7 * std::sin(3 * angle), 2.6 * std::sin(angle)},
                                       {1 + std::cos(angle), 1 + std::sin(angle), 0.2 + 0.1 * (i % 5)}));
  }
  for (int i = 0; i < 4; ++i)
    scene.lights.push_back(directional_light({std::cos(1.3 * i), -0.7, std::sin(1.3 * i)}, glm::dvec3(0.2 + 0.1 * i)));
  hold(scene, {8, 6}, "32");
}

TEST(OpacityPropagation, GridOfOneCell) {
  for (const glm::ivec3 size : {glm::ivec3(1), glm::ivec3(1, 5, 1)}) {
    Scene scene;
    scene.camera.position = {0.5, 1.3, 5};
    scene.camera.look_at = {0.2, 0.4, 0};
    GridMedium grid;
    std::vector<float> values;
    for (int i = 0; i < size.x * size.y * size.z; ++i) values.push_back(1 - 0.17F * static_cast<float>(i));
    grid.voxels = std::make_shared<const VoxelGrid>(VoxelGrid{size, values});
    grid.scale = 0.8;
    grid.albedo = {0.9, 0.8, 0.7};
    grid.transform[3] = glm::dvec4(-0.3, -0.6, -0.4, 1);
    scene.medium.grid = grid;
    scene.lights = {point_light({1.9, 1.4, 0.8}, {6, 5, 4}), directional_light({-0.3, -1, -0.2}, {0.5, 0.6, 0.9})};
    std::printf("%d x %d x %d\n", size.x, size.y, size.z);
    hold(scene, {48, 36});
  }
}

}  // namespace
}  // namespace airlight
