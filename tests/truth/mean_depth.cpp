// Mean optical depths of voxel grids over all directions: of the Gaussians that stand for their blocks, beside sums over
// directions; and what comes through a grid of an environment, beside the reference, which attenuates each direction by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "app/airlight.h"
#include "common/formulas/double.h"
#include "common/plan/grid_gaussians.h"
#include "common/plan/network.h"
#include "common/reference/grid.h"
#include "common/reference/reference.h"
#include "common/relative_rmse.h"
#include "tests/tolerances.h"
#include "tests/truth/scenes.h"

namespace airlight {
namespace {

double mean_over_directions(const GridField& field, const glm::dvec3& place, int count) {
  double sum = 0;
  for (const glm::dvec3& d : network_directions(count)) sum += field.depth(place, d, 1e6) + field.depth(place, -d, 1e6);
  return sum / (2 * count);
}

double of_gaussians(const std::vector<GaussianDensity>& gaussians, const glm::dvec3& place) {
  double sum = 0;
  for (const GaussianDensity& g : gaussians) {
    const auto radius = static_cast<double>(g.radius);
    const glm::dvec3 e = (glm::dvec3(g.center) - place) / radius;
    sum += f64::average_gaussian_depth(glm::dot(e, e)) * radius * static_cast<double>(g.extinction);
  }
  return sum;
}

struct Errors {
  double rms = 0, worst = 0;
};

template <class Depth>
Errors errors(const std::vector<glm::dvec3>& places, const std::vector<double>& truth, Depth&& depth) {
  Errors e;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double wrong = std::fabs(depth(places[i]) - truth[i]);
    e.rms += wrong * wrong / static_cast<double>(places.size()), e.worst = std::max(e.worst, wrong);
  }
  e.rms = std::sqrt(e.rms);
  return e;
}

// Smoke that winds upward, of cells of unequal sides, turned; about 2 m high.
GridMedium winding_smoke() {
  auto voxels = std::make_shared<VoxelGrid>();
  voxels->size = {24, 20, 36};
  for (int z = 0; z < voxels->size.z; ++z) {
    for (int y = 0; y < voxels->size.y; ++y) {
      for (int x = 0; x < voxels->size.x; ++x) {
        const double u = (x + 0.5) / 24 - 0.5, v = (y + 0.5) / 20 - 0.5, w = (z + 0.5) / 36;
        const double away = std::hypot(u - 0.2 * std::sin(7 * w), v - 0.2 * std::cos(7 * w));
        voxels->values.push_back(static_cast<float>(std::max(0.0, 1 - away / 0.2) * (1 + 0.5 * std::sin(40 * w))));
      }
    }
  }
  GridMedium grid{.voxels = voxels, .scale = 6};
  grid.transform = glm::translate(glm::dmat4(1), {-0.6, -0.1, 0.5}) * glm::rotate(glm::dmat4(1), -1.5, {1, 0.1, 0}) *
                   glm::scale(glm::dmat4(1), {0.05, 0.06, 0.055});
  return grid;
}

GridMedium plume() { return *load_scene(AIRLIGHT_SCENES "/smoke.json").medium.grid; }

std::vector<glm::dvec3> spiral(double radius, double height, int count) {
  std::vector<glm::dvec3> places;
  for (int i = 0; i < count; ++i) {
    const double up = (i + 0.5) / count;
    places.emplace_back(radius * std::cos(2.4 * i), height * up, radius * std::sin(2.4 * i));
  }
  return places;
}

TEST(MeanDepthOfGrids, OfBlocksApproachesSumsOverDirections) {
  const GridMedium grid = winding_smoke();
  const GridField field(grid);
  for (const double radius : {0.3, 0.9}) {
    const std::vector<glm::dvec3> places = spiral(radius, 2, 8);
    std::vector<double> truth;
    double claimed = 0;
    for (const glm::dvec3& p : places) {
      truth.push_back(mean_over_directions(field, p, 8001));
      claimed = std::max(claimed, std::fabs(truth.back() - mean_over_directions(field, p, 4001)));
    }
    std::printf("%.1f m off the axis: depth up to %.3f, known to %.1e\n", radius, *std::max_element(truth.begin(), truth.end()),
                claimed);
    double before = 0;
    for (const int along : {4, 16}) {
      const std::vector<GaussianDensity> gaussians = grid_gaussians(grid, grid_blocks(grid, along), {0, 0, 0});
      const Errors e = errors(places, truth, [&](const glm::dvec3& p) { return of_gaussians(gaussians, p); });
      std::printf("  %zu Gaussians of %d blocks along it: RMS %.4f, at most %.4f off\n", gaussians.size(), along, e.rms, e.worst);
      if (along == 16) {
        EXPECT_FALSE(!(e.worst <= tolerance(radius < 0.5 ? "mean_depth_inside" : "mean_depth_outside")));
        EXPECT_LT(e.rms, before / 2);
      }
      before = e.rms;
    }
  }
}

// The table of docs/RESULTS.md: of the plume of scenes/, by blocks and by few directions.
TEST(MeanDepthTable, DISABLED_OfThePlume) {
  const GridMedium grid = plume();
  const GridField field(grid);
  for (const auto& [name, radius, height] :
       {std::tuple("in it", 0.3, 2.4), {"beside it", 0.7, 2.4}, {"on the floor", 1.2, 0.0}}) {
    const std::vector<glm::dvec3> places = spiral(radius, height, 24);
    std::vector<double> truth;
    for (const glm::dvec3& p : places) truth.push_back(mean_over_directions(field, p, 10001));
    std::printf("%s: depth up to %.3f\n", name, *std::max_element(truth.begin(), truth.end()));
    for (const int along : {4, 8, 12, 16, 24}) {
      const std::vector<GaussianDensity> gaussians = grid_gaussians(grid, grid_blocks(grid, along), {0, 0, 0});
      const Errors e = errors(places, truth, [&](const glm::dvec3& p) { return of_gaussians(gaussians, p); });
      std::printf("  %d blocks along it, %zu Gaussians: RMS %.4f, at most %.4f off\n", along, gaussians.size(), e.rms, e.worst);
    }
    for (const int lines : {8, 32, 128}) {
      const Errors e = errors(places, truth, [&](const glm::dvec3& p) { return mean_over_directions(field, p, lines); });
      std::printf("  %d directions: RMS %.4f, at most %.4f off\n", 2 * lines, e.rms, e.worst);
    }
  }
}

// Bright above, dim below, brighter toward -X.
Environment sky() {
  constexpr Extent extent{16, 8};
  auto image = std::make_shared<HostImage>(extent, 3);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const double up = 1 - 2 * (y + 0.5) / extent.height, west = std::cos(2 * 3.14159265358979 * (x + 0.5 - 4) / extent.width);
      for (int c = 0; c < 3; ++c) image->at(x, y, c) = static_cast<float>(1 + 0.6 * up + (1 - up * up) * west * (0.5 - 0.1 * c));
    }
  }
  return {image, {1, 1, 1}, 0};
}

Scene box_in(const GridMedium& grid) {
  Scene scene;
  scene.environment = sky();
  scene.camera.position = {1.2, 2.8, 3.4}, scene.camera.look_at = {0, 0.3, 0};
  scene.medium.grid = grid;
  Mesh floor;
  add_parallelogram(floor, {-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
  scene.surfaces = {surface(std::move(floor), diffuse(0.6F, 0.5F, 0.4F), false),
                    surface(box({0.2, 0, -0.3}, {0.8, 0.7, 0.4}), diffuse(0.6F, 0.6F, 0.6F), false)};
  return scene;
}

struct SurfaceTruth {
  Extent extent;
  std::vector<ReferencePixel> pixels;
  std::vector<bool> counts;
};

SurfaceTruth truth_of(const Scene& scene, Extent extent) {
  const Reference reference(scene);
  SurfaceTruth truth{extent, {}, {}};
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      truth.pixels.push_back(reference.pixel({x + 0.5, y + 0.5}, extent, {true, false}));
      truth.counts.push_back(truth.pixels.back().surface_index >= 0 && !reference.edge({x + 0.5, y + 0.5}, extent));
    }
  }
  return truth;
}

// Of the light alone, whatever comes through the view ray; and beside another picture.
struct Beside {
  RelativeRmse truth, other;
};
Beside compare(const SurfaceTruth& truth, const Frame& frame, const HostImage& other) {
  const HostImage &image = frame.image("surface.environment"), &through = frame.image("transmittance");
  Beside b;
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const ReferencePixel& p = truth.pixels[i / 3];
    const auto seen = static_cast<double>(through.values[i / 3]);
    if (!truth.counts[i / 3] || !(seen > 1e-3)) continue;
    b.truth.add(static_cast<double>(image.values[i]) / seen, p.surface_environment[static_cast<int>(i % 3)] / p.transmittance);
    if (!other.values.empty()) b.other.add(static_cast<double>(image.values[i]), static_cast<double>(other.values[i]));
  }
  return b;
}

Frame rendered(const Scene& scene, const char* backend, const char* technique, Extent extent,
               std::vector<std::pair<std::string, std::string>> knobs) {
  Renderer renderer({.backend = backend, .gl_context = "osmesa"});
  RenderSettings settings;
  settings.technique = technique;
  settings.resolution = extent;
  settings.knobs = std::move(knobs);
  settings.images = {"surface.environment", "surface", "transmittance"};
  return renderer.render(scene, settings);
}

// Another table of docs/RESULTS.md: the plume beside a box, as thick as it is and thinner.
TEST(EnvironmentInGridsTable, DISABLED_OfThePlume) {
  for (const double thickness : {0.1, 0.3, 1.0}) {
    Scene scene = box_in(plume());
    scene.medium.grid->scale *= thickness;
    constexpr Extent extent{16, 12};
    const SurfaceTruth truth = truth_of(scene, extent);
    std::printf("%g of its extinction\n", thickness);
    for (const char* blocks : {"4", "8", "16", "32"}) {
      HostImage of_pixels;
      for (const char* choice : {"pixel", "lattice"}) {
        const Frame frame =
            rendered(scene, "cpu", "marching", extent, {{"environment_depth", choice}, {"environment_blocks", blocks}});
        const Beside b = compare(truth, frame, of_pixels);
        std::printf("  %s blocks, %s: relative RMSE %.2f %%, to a depth a pixel %.3f %%\n", blocks, choice, 100 * b.truth.value(),
                    100 * b.other.value());
        if (of_pixels.values.empty()) of_pixels = frame.image("surface.environment");
      }
    }
    scene.medium.grid.reset();
    const Beside none = compare(truth, rendered(scene, "cpu", "marching", extent, {}), {});
    std::printf("  unattenuated: relative RMSE %.2f %%\n", 100 * none.truth.value());
  }
}

class EnvironmentInGrids : public testing::TestWithParam<std::string> {};

TEST_P(EnvironmentInGrids, StatesTheDistance) {
  const Scene scene = box_in(plume());
  constexpr Extent extent{12, 9};
  const SurfaceTruth truth = truth_of(scene, extent);
  for (const char* technique : {"marching", "opacity-propagation", "illumination-network"}) {
    if (GetParam() == "gl" && technique != std::string_view("marching")) continue;  // the same steps
    std::vector<std::pair<std::string, std::string>> few;
    if (technique == std::string_view("illumination-network"))
      few = {{"particles", "8"}, {"directions", "4"}, {"resolution", "4"}};
    HostImage of_pixels;
    for (const char* choice : {"pixel", "lattice", "object"}) {
      auto knobs = few;
      knobs.emplace_back("environment_depth", choice);
      const Frame frame = rendered(scene, GetParam().c_str(), technique, extent, knobs);
      const Beside b = compare(truth, frame, of_pixels);
      std::printf("%s %s: relative RMSE %.2f %%, to a depth a pixel %.3f %%\n", technique, choice, 100 * b.truth.value(),
                  100 * b.other.value());
      EXPECT_GT(b.truth.mean_truth(), 0.1);
      if (choice == std::string_view("object")) {
        EXPECT_GT(b.truth.value(), 2 * tolerance("environment_in_grid"));  // a floor about a plume is not one depth
        continue;
      }
      EXPECT_FALSE(!(b.truth.value() <= tolerance("environment_in_grid")));
      if (choice == std::string_view("lattice")) {
        EXPECT_GT(b.other.value(), 0);
        EXPECT_FALSE(!(b.other.value() <= tolerance("environment_in_grid_lattice")));
      }
      if (of_pixels.values.empty()) of_pixels = frame.image("surface.environment");
    }
  }
  Scene clear = scene;
  clear.medium.grid.reset();
  const Beside none = compare(truth, rendered(clear, GetParam().c_str(), "marching", extent, {}), {});
  std::printf("unattenuated: relative RMSE %.2f %%\n", 100 * none.truth.value());
  EXPECT_GT(none.truth.value(), 1.3 * tolerance("environment_in_grid"));
}

// A Gaussian's values in a grid light surfaces as the Gaussian does, also by what they scatter onto these.
TEST_P(EnvironmentInGrids, AreGaussiansWhereTheyHoldOne) {
  const Gaussian blob{.center = {-0.1, 0.6, 0.1}, .radius = 0.5, .extinction = 2, .albedo = {0.9, 0.8, 0.7}};
  auto voxels = std::make_shared<VoxelGrid>();
  voxels->size = {30, 30, 30};
  constexpr double cell = 0.1;
  for (int z = 0; z < 30; ++z) {
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 30; ++x) {
        const glm::dvec3 e = cell * (glm::dvec3(x, y, z) - 14.5) / blob.radius;
        voxels->values.push_back(static_cast<float>(std::exp(-glm::dot(e, e))));
      }
    }
  }
  GridMedium grid{.voxels = voxels, .scale = blob.extinction, .albedo = blob.albedo};
  grid.transform = glm::translate(glm::dmat4(1), blob.center) * glm::scale(glm::dmat4(1), glm::dvec3(cell)) *
                   glm::translate(glm::dmat4(1), glm::dvec3(-15));
  const Scene by_grid = box_in(grid);
  Scene by_gaussian = by_grid;
  by_gaussian.medium.grid.reset();
  by_gaussian.medium.gaussians = {blob};
  const std::vector<std::pair<std::string, std::string>> knobs{{"environment_indirect", "on"}, {"steps", "64"}};
  const Frame a = rendered(by_grid, GetParam().c_str(), "marching", {16, 12}, knobs),
              b = rendered(by_gaussian, GetParam().c_str(), "marching", {16, 12}, knobs);
  RelativeRmse all, scattered;
  for (std::size_t i = 0; i < a.image("surface").values.size(); ++i) {
    const auto part = [&](const Frame& f) {
      return static_cast<double>(f.image("surface").values[i]) - static_cast<double>(f.image("surface.environment").values[i]);
    };
    all.add(static_cast<double>(a.image("surface").values[i]), static_cast<double>(b.image("surface").values[i]));
    scattered.add(part(a), part(b));
  }
  std::printf("relative RMSE of all %.3f %%, of what is scattered %.3f %%\n", 100 * all.value(), 100 * scattered.value());
  EXPECT_GT(scattered.mean_truth(), 0.01);
  EXPECT_FALSE(!(all.value() <= tolerance("environment_grid_of_gaussian")));
  EXPECT_FALSE(!(scattered.value() <= tolerance("environment_grid_scattered")));
}

INSTANTIATE_TEST_SUITE_P(Backends, EnvironmentInGrids, testing::Values("cpu", "gl"), [](const auto& test) { return test.param; });

}  // namespace
}  // namespace airlight
