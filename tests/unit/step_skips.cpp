// What steps tell that they passed over inside themselves: where it is known in closed form, for any number of threads, and of
// bands and samples together.
#include "common/plan/step_skips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>

#include "app/airlight.h"
#include "app/plan_tree.h"
#include "common/plan/geometry.h"
#include "common/techniques/technique.h"
#include "cpu/targets.h"
#include "tests/unit/small_work.h"

namespace airlight {
namespace {

constexpr int side = 128;
constexpr std::uint64_t pixels = std::uint64_t{side} * side;

// A view of 90 degrees along -z: x / z of a pixel's centre is (2 i + 1) / side - 1.
Work looking_ahead(const char* technique) {
  Work work;
  work.settings.technique = technique;
  work.settings.resolution = Extent{side, side};
  work.scene.camera = {.position = {0, 0, 0}, .look_at = {0, 0, -1}, .vertical_fov = 90};
  work.scene.sky_distance = 100;
  LightSource lamp;
  lamp.position = {0, 3, -5};
  lamp.power = {5, 4, 3};
  work.scene.lights.push_back(lamp);
  return work;
}

// Within three pixels of the corner that the four squares in the middle share.
Gaussian small_and_far() { return {.center = {0, 0, -20}, .radius = 0.1, .extinction = 1}; }

// A rectangle before the camera, 10 m away.
std::shared_ptr<const Mesh> wall(float left, float right, float bottom, float top) {
  auto mesh = std::make_shared<Mesh>();
  for (const glm::vec2 p : {glm::vec2(left, bottom), glm::vec2(right, bottom), glm::vec2(right, top), glm::vec2(left, top)}) {
    mesh->positions.emplace_back(10 * p.x, 10 * p.y, -10);
    mesh->normals.emplace_back(0, 0, 1);
  }
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

void add_wall(Scene& scene, float left, float right, float bottom, float top) {
  Surface surface;
  surface.mesh = wall(left, right, bottom, top);
  scene.surfaces.push_back(surface);
}

StepStats step_of(const Frame& frame, std::string_view name) {
  for (const StepStats& step : frame.stats.steps) {
    if (step.name != name) continue;
    std::printf("%s: %llu items, %llu skipped (%s); %llu %s, %llu skipped (%s)\n", step.name.c_str(),
                static_cast<unsigned long long>(step.items), static_cast<unsigned long long>(step.skipped),
                std::string(step.why_skipped).c_str(), static_cast<unsigned long long>(step.parts.all),
                std::string(step.parts.name).c_str(), static_cast<unsigned long long>(step.parts.skipped),
                std::string(step.parts.why).c_str());
    return step;
  }
  ADD_FAILURE() << name << " is not there";
  return {};
}

Frame render(const Work& work, const std::string& simd = "auto", int threads = 2) {
  return Renderer({.backend = "cpu", .simd = simd, .threads = threads}).render(work.scene, work.settings);
}

TEST(StepSkips, SquaresWithoutGaussians) {
  Work work = looking_ahead("gaussian-airlight");
  work.scene.medium.gaussians = {small_and_far()};
  for (const char* light_path : {"exact", "published"}) {
    work.set("light_path", light_path);
    const StepStats step =
        step_of(render(work), light_path == std::string("exact") ? "gaussian_airlight" : "projected_gaussians");
    EXPECT_TRUE(step.counted);
    EXPECT_EQ(step.items, pixels);
    EXPECT_EQ(step.skipped, pixels - 4 * 16 * 16);
  }
}

// Panels behind a wall that stands before all that there is are passed over: all of them, or none without the wall.
TEST(StepSkips, PanelsBehindSurfaces) {
  Work work = looking_ahead("gaussian-airlight");
  work.scene.medium.gaussians = {small_and_far()};
  const StepStats open = step_of(render(work), "gaussian_airlight");
  EXPECT_GT(open.parts.all, 0U);
  EXPECT_EQ(open.parts.skipped, 0U);
  add_wall(work.scene, -1.1F, 1.1F, -1.1F, 1.1F);
  work.set("shadows", "off");
  const StepStats closed = step_of(render(work), "gaussian_airlight");
  EXPECT_EQ(closed.parts.all, open.parts.all);
  EXPECT_EQ(closed.parts.skipped, closed.parts.all);
}

// A target of one lane passes over exactly the rays that meet nothing, others vectors of them.
TEST(StepSkips, RaysThatMeetNoMedium) {
  Work work = looking_ahead("marching");
  work.set("steps", "8");
  Gaussian blob = small_and_far();
  blob.radius = 1;
  work.scene.medium.gaussians = {blob};
  const FrameRequest request{.extent = *work.settings.resolution, .images = {"beauty"}, .knobs = {}};
  const View view = view_of(work.scene, request);
  const double reach = static_cast<double>(gaussians_of(work.scene).at(0).reach);
  std::uint64_t met = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const glm::dvec3 d = glm::normalize(glm::dvec3((2 * x + 1.0) / side - 1, 1 - (2 * y + 1.0) / side, -1));
      met += glm::length(glm::cross(d, blob.center)) < reach ? 1 : 0;
    }
  }
  EXPECT_EQ(view.extent, request.extent);
  ASSERT_GT(met, 100U);
  for (const Simd simd : available_simd()) {
    const std::string name = simd == Simd::scalar   ? "scalar"
                             : simd == Simd::avx2   ? "avx2"
                             : simd == Simd::avx512 ? "avx512"
                                                    : "neon";
    const StepStats step = step_of(render(work, name), "ray_march");
    EXPECT_EQ(step.items, pixels);
    EXPECT_LE(step.skipped, pixels - met) << name;
    EXPECT_GE(step.skipped, pixels - met - 2 * 16 * 64U) << name;
    if (simd != Simd::scalar) continue;
    EXPECT_EQ(step.skipped, pixels - met);
    EXPECT_EQ(step.parts.all, met * 8);
    EXPECT_EQ(step.parts.skipped, 0U);
  }
}

// Rays end within a dense cloud: steps behind that are passed over, half of them at most for a ray through its middle.
TEST(StepSkips, StepsBehindDenseFog) {
  Work work = looking_ahead("marching");
  work.set("steps", "8");
  work.scene.medium.gaussians = {{.center = {0, 0, -20}, .radius = 1, .extinction = 400}};
  const StepStats dense = step_of(render(work, "scalar"), "ray_march");
  work.scene.medium.gaussians[0].extinction = 1e-3;
  const StepStats thin = step_of(render(work, "scalar"), "ray_march");
  EXPECT_EQ(thin.parts.skipped, 0U);
  EXPECT_GT(dense.parts.skipped, 0U);
  EXPECT_LT(dense.parts.skipped, dense.parts.all / 2);
}

// A wall over the left half of the picture, which is whole tiles; beside it a triangle behind the camera and one between pixels.
TEST(StepSkips, PixelsWithoutSurfacesAndTrianglesWithoutPixels) {
  Work work = looking_ahead("shadow-planes");
  work.scene.medium.extinction = 0.1;
  add_wall(work.scene, -1.1F, 0, -1.1F, 1.1F);
  Surface others;
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{0, 0, 10}, {1, 0, 10}, {0, 1, 10}, {0.01F, 0, -10}, {0.02F, 0, -10}, {0.01F, 0.01F, -10}};
  mesh->normals.assign(6, {0, 0, 1});
  mesh->triangles = {{0, 1, 2}, {3, 4, 5}};
  others.mesh = mesh;
  work.scene.surfaces.push_back(others);
  const Frame frame = render(work);
  const StepStats visibility = step_of(frame, "surface_visibility");
  EXPECT_EQ(visibility.skipped, pixels / 2);
  EXPECT_EQ(visibility.parts.all, 4U);
  EXPECT_EQ(visibility.parts.skipped, 2U);
  for (const char* name : {"surface_shading", "surface_airlight"}) EXPECT_EQ(step_of(frame, name).skipped, pixels / 2) << name;
  const StepStats compose = step_of(frame, "compose");
  EXPECT_TRUE(compose.counted);
  EXPECT_EQ(compose.skipped, 0U);
  const std::string text = stats_text(frame);
  EXPECT_NE(
      text.find("8192 items skipped: no triangle is in their tile; 4 triangles, 2 skipped: off the screen or between pixels"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("; no item skipped)"), std::string::npos) << text;
}

// Beside the tiles that explain() counts from the volumes.
TEST(StepSkips, TilesWithoutShadowPlanes) {
  Work work = looking_ahead("shadow-planes");
  work.settings.resolution = Extent{4 * side, 3 * side};
  work.scene.medium.extinction = 0.1;
  add_wall(work.scene, -0.1F, 0.1F, -0.1F, 0.1F);
  const StepStats step = step_of(render(work), "shadow_planes");
  const std::string told = explain(work.scene, work.settings);
  const std::size_t at = told.find("shadow planes in ");
  ASSERT_NE(at, std::string::npos) << told;
  const std::uint64_t tiles = std::stoul(told.substr(at + 17));
  EXPECT_GT(tiles, 10U);
  EXPECT_EQ(step.skipped, tiles * 64 * 64);
  EXPECT_EQ(step.parts.all, step.items);
  EXPECT_EQ(step.parts.skipped, step.skipped);
}

// Steps that make volumes: 4^3 cells of which a Gaussian may be in none, or in all.
TEST(StepSkips, VolumesCountWhatIsOutOfReach) {
  Work work = small_work("opacity-propagation");
  work.set("density", "volume");
  work.scene.medium.gaussians = {{.center = {-1, 0.5, 0}, .radius = 0.1, .extinction = 1},
                                 {.center = {1, 0.5, 0}, .radius = 0.1, .extinction = 1}};
  const Frame frame = render(work);
  const StepStats cells = step_of(frame, "density_injection");
  EXPECT_GT(cells.parts.skipped, 0U);
  EXPECT_LT(cells.parts.skipped, cells.parts.all);
  EXPECT_EQ(cells.parts.all % 2, 0U);
  work.set("density", "auto");
  const StepStats ways = step_of(render(work), "optical_depth_propagation");
  EXPECT_GT(ways.parts.skipped, 0U);
  EXPECT_LT(ways.parts.skipped, ways.parts.all);
}

std::vector<std::uint64_t> counts_of(const Frame& frame) {
  std::vector<std::uint64_t> all;
  for (const StepStats& s : frame.stats.steps) all.insert(all.end(), {s.items, s.skipped, s.parts.all, s.parts.skipped});
  return all;
}

// Also at the border of pictures that end within a tile, and of bands of rows.
TEST(StepSkips, AreTheSameForAnyNumberOfThreadsAndBandsOfRows) {
  for (const Technique& t : techniques()) {
    if (!t.plan) continue;
    Work work = small_work(t.name);
    work.settings.resolution = Extent{150, 140};
    const Frame one = render(work, "auto", 1);
    for (const StepStats& s : one.stats.steps) {
      EXPECT_TRUE(s.counted) << s.name;
      EXPECT_LE(s.skipped, s.items) << s.name;
      EXPECT_LE(s.parts.skipped, s.parts.all) << s.name;
      EXPECT_TRUE(s.skipped == 0 || !s.why_skipped.empty()) << s.name;
      EXPECT_TRUE(s.parts.all == 0 || (!s.parts.name.empty() && !s.parts.why.empty())) << s.name;
    }
    const std::vector<std::uint64_t> counts = counts_of(one);
    for (const int threads : {2, 3}) EXPECT_EQ(counts_of(render(work, "auto", threads)), counts) << t.name;
    Stats bands;
    for (const Rows rows : {Rows{0, 64}, Rows{64, 140}}) {
      work.settings.rows = rows;
      const Frame band = render(work);
      if (bands.steps.empty()) {
        bands = band.stats;
      } else {
        add(bands, band.stats);
      }
    }
    for (std::size_t i = 0; i < bands.steps.size(); ++i) {
      const StepStats &of_bands = bands.steps[i], &whole = one.stats.steps[i];
      if (whole.parts.name == "triangles" || of_bands.items != whole.items) continue;  // once a band, and volumes
      EXPECT_EQ(of_bands.skipped, whole.skipped) << whole.name;
      EXPECT_EQ(of_bands.parts.all, whole.parts.all) << whole.name;
      EXPECT_EQ(of_bands.parts.skipped, whole.parts.skipped) << whole.name;
    }
  }
}

// What is not known is not told.
TEST(StepSkips, AreUnknownOnGl) {
  Work work = small_work("marching");
  const Frame frame = Renderer({.backend = "gl", .gl_context = "osmesa"}).render(work.scene, work.settings);
  for (const StepStats& s : frame.stats.steps) EXPECT_FALSE(s.counted) << s.name;
  const std::string text = stats_text(frame);
  EXPECT_EQ(text.find("skipped"), std::string::npos) << text;
}

}  // namespace
}  // namespace airlight
