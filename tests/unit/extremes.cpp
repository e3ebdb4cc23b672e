// Whatever loads renders to finite numbers: scenes at the ends of what a scene file may say, on both backends.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/airlight.h"
#include "common/techniques/technique.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

// Draws from lists of extreme and ordinary values, by a counter.
class Draw {
 public:
  explicit Draw(std::uint32_t seed) : seed_(seed) {}
  template <std::size_t n>
  double of(const std::array<double, n>& values) {
    return values[static_cast<std::size_t>(static_cast<double>(n) * unit())];
  }
  double unit() { return uniform(seed_, next_++); }
  double between(double low, double high) { return low + (high - low) * unit(); }
  glm::dvec3 vector(double reach) { return {between(-reach, reach), between(-reach, reach), between(-reach, reach)}; }

 private:
  std::uint32_t seed_, next_ = 0;
};

Mesh triangles(Draw& draw) {
  Mesh mesh;
  const double size = draw.of(std::array{1e-6, 1.0, 10.0, 1e6, 1e9});
  for (unsigned i = 0; i < 30; ++i) {
    mesh.positions.emplace_back(draw.vector(size));
    mesh.normals.push_back(glm::normalize(glm::vec3(draw.vector(1)) + glm::vec3(0, 1e-3F, 0)));
  }
  for (unsigned i = 0; i < 30; ++i) {
    // Some without an area: a corner twice.
    mesh.triangles.emplace_back(i, (i * 7 + 1) % 30, i % 5 == 0 ? i : (i * 11 + 2) % 30);
  }
  return mesh;
}

Scene extreme_scene(std::uint32_t seed) {
  Draw draw(seed);
  Scene s;
  s.camera.position = draw.vector(draw.of(std::array{0.0, 1.0, 1e3, 1e8}));
  s.camera.look_at = s.camera.position + glm::dvec3(0, 0, -1) + draw.vector(0.3);
  s.camera.vertical_fov = draw.of(std::array{0.01, 1.0, 45.0, 120.0, 179.0});
  s.camera.resolution = {40, 30};
  s.sky_distance = draw.of(std::array{0.0, 1e-6, 10.0, 1e9, static_cast<double>(INFINITY)});
  s.medium.extinction = draw.of(std::array{0.0, 1e-30, 1e-12, 1e-3, 0.3, 10.0, 1e3, 1e6});
  s.medium.phase.kind = static_cast<PhaseKind>(static_cast<int>(draw.between(0, 6)));
  const bool peaked = s.medium.phase.kind == PhaseKind::henyey_greenstein || s.medium.phase.kind == PhaseKind::cornette_shanks;
  s.medium.phase.g = peaked ? draw.of(std::array{-0.99, -0.6, 0.0, 0.6, 0.99}) : 0;
  s.medium.albedo = glm::dvec3(draw.of(std::array{0.0, 0.5, 1.0}));
  s.medium.ambient = glm::dvec3(draw.of(std::array{0.0, 0.1, 1e12}));
  s.medium.emission = glm::dvec3(draw.of(std::array{0.0, 1.0}));
  s.background = glm::dvec3(draw.of(std::array{0.0, 1.0, 1e12}));
  for (int i = 0; i < 4; ++i) {
    LightSource light;
    const glm::dvec3 forward = s.camera.look_at - s.camera.position;
    switch (static_cast<int>(draw.between(0, 5))) {
      case 0:
        light.position = s.camera.position;
        break;
      case 1:
        light.position = s.camera.position + 3.0 * forward;
        break;  // on the middle of the view
      case 2:
        light.position = s.camera.position - 2.0 * forward;
        break;
      case 3:
        light.position = s.camera.position + draw.vector(1e8);
        break;
      default:
        light.type = LightType::directional;
        light.direction = glm::normalize(forward + draw.vector(draw.of(std::array{0.0, 1e-6, 1.0})));
    }
    light.power = glm::dvec3(draw.of(std::array{0.0, 1e-12, 1.0, 1e12}), 1, 0);
    light.radius = draw.of(std::array{1e-6, 1e-3, 1.0, 1e6});
    s.lights.push_back(light);
  }
  const int surfaces = static_cast<int>(draw.between(0, 3));
  for (int i = 0; i < surfaces; ++i) {
    Surface surface;
    surface.mesh = std::make_shared<const Mesh>(triangles(draw));
    surface.transform[3] = glm::dvec4(s.camera.position + draw.vector(2), 1);
    surface.material.specular = glm::vec3(glm::dvec3(draw.of(std::array{0.0, 1.0})));
    surface.material.shininess = static_cast<float>(draw.of(std::array{0.0, 1.0, 1e4}));
    s.surfaces.push_back(surface);
  }
  return s;
}

// The same with Gaussians and a grid.
Scene extreme_medium(std::uint32_t seed) {
  Scene s = extreme_scene(seed);
  Draw draw(seed + 5000);
  const int gaussians = static_cast<int>(draw.between(0, 5));
  for (int i = 0; i < gaussians; ++i) {
    Gaussian g;
    g.radius = draw.of(std::array{1e-6, 1e-3, 0.5, 3.0, 1e3, 1e6});
    g.center = s.camera.position + draw.vector(draw.of(std::array{0.0, 1.0, 10.0, 1e8}));
    g.extinction = draw.of(std::array{0.0, 1e-30, 1e-6, 1.0, 1e3, 1e6});
    g.albedo = glm::dvec3(draw.of(std::array{0.0, 0.5, 1.0}));
    g.emission = glm::dvec3(draw.of(std::array{0.0, 1.0, 1e12}));
    s.medium.gaussians.push_back(g);
  }
  if (draw.unit() < 0.5) {
    auto voxels = std::make_shared<VoxelGrid>();
    voxels->size = {static_cast<int>(draw.between(1, 9)), static_cast<int>(draw.between(1, 3)), 5};
    for (int i = 0; i < voxels->size.x * voxels->size.y * voxels->size.z; ++i)
      voxels->values.push_back(static_cast<float>(draw.of(std::array{0.0, 0.0, 1e-30, 1.0, 1e3})));
    GridMedium grid{.voxels = voxels, .scale = draw.of(std::array{1e-6, 1.0, 1e3}), .albedo = glm::dvec3(draw.unit())};
    const double size = draw.of(std::array{1e-6, 0.3, 10.0, 1e6});
    grid.transform = glm::dmat4(size);
    grid.transform[1] *= draw.of(std::array{1.0, 1e-3});
    grid.transform[3] = glm::dvec4(s.camera.position - size * draw.vector(4), 1);
    s.medium.grid = grid;
  }
  return s;
}

// On OpenGL a scene in three: most of its time goes into compiling shaders. tests/stability draws more, and holds them to more.
class Extremes : public testing::TestWithParam<std::string> {
 protected:
  std::uint32_t count(std::uint32_t scenes) const { return GetParam() == "gl" ? (scenes + 2) / 3 : scenes; }
};

void expect_finite(const std::string& backend, Scene (*make)(std::uint32_t), const RenderSettings& asked, std::uint32_t scenes) {
  Renderer renderer({.backend = backend, .gl_context = "osmesa"});
  float largest = 0;
  for (std::uint32_t seed = 1; seed <= scenes; ++seed) {
    const Scene scene = make(seed);
    RenderSettings settings = asked;
    settings.images = image_names(scene);
    // Splats have no airlight of one light.
    if (std::find(asked.knobs.begin(), asked.knobs.end(), std::pair<std::string, std::string>{"image", "splats"}) !=
        asked.knobs.end())
      std::erase_if(settings.images, [](const std::string& name) { return name.starts_with("airlight."); });
    const Frame frame = renderer.render(scene, settings);
    for (const NamedImage& i : frame.images) {
      for (const float v : i.image.values) {
        ASSERT_TRUE(std::isfinite(v) && (v >= 0 || i.name == "normal")) << "scene " << seed << ", " << i.name << ": " << v;
        if (i.name == "beauty") largest = std::max(largest, v);
      }
    }
  }
  std::printf("%u scenes, largest radiance %.3g\n", scenes, static_cast<double>(largest));
}

TEST_P(Extremes, GiveFiniteNumbers) { expect_finite(GetParam(), extreme_scene, {}, count(60)); }

TEST_P(Extremes, GiveFiniteNumbersWhenMarched) {
  RenderSettings settings;
  settings.technique = "marching";
  settings.knobs = {{"steps", "6"}, {"light_steps", "3"}};
  expect_finite(GetParam(), extreme_medium, settings, count(40));
  settings.knobs.emplace_back("shadow", "march");
  expect_finite(GetParam(), extreme_medium, settings, count(40));
}

// The same without the grid, half of them in an environment.
Scene extreme_gaussians(std::uint32_t seed) {
  Scene s = extreme_medium(seed);
  s.medium.grid.reset();
  if (seed % 2 == 0) s.environment = Environment{nullptr, {seed % 4 == 0 ? 1e12 : 1.0, 1e-12, 0}, 30};
  return s;
}

TEST_P(Extremes, GiveFiniteNumbersOfGaussians) {
  RenderSettings settings;
  settings.technique = "gaussian-airlight";
  settings.knobs = {{"samples", "3"}, {"environment_rays", "16"}};
  expect_finite(GetParam(), extreme_gaussians, settings, count(25));
  settings.knobs = {{"light_path", "published"}, {"shadows", "off"}, {"environment_rays", "16"}};
  expect_finite(GetParam(), extreme_gaussians, settings, count(25));
}

TEST_P(Extremes, GiveFiniteNumbersOfParticles) {
  const auto make = [](std::uint32_t seed) {
    Scene s = extreme_medium(seed);
    if (s.medium.gaussians.empty() && !s.medium.grid) s.medium.gaussians.push_back({});
    return s;
  };
  RenderSettings settings;
  settings.technique = "illumination-network";
  settings.knobs = {{"particles", "30"}, {"directions", "5"}, {"iterations", "12"}, {"resolution", "3"}, {"steps", "3"}};
  const bool gl = GetParam() == "gl";  // which compiles most of its time
  expect_finite(GetParam(), make, settings, gl ? 5 : 25);
  settings.knobs = {{"particles", "1"}, {"directions", "1"}, {"resolution", "2"}, {"steps", "2"}};
  expect_finite(GetParam(), make, settings, gl ? 3 : 15);
  settings.knobs.emplace_back("image", "splats");
  if (!gl) expect_finite(GetParam(), make, settings, 15);
  settings.knobs = {{"particles", "30"}, {"directions", "5"}, {"iterations", "12"}, {"steps", "3"}, {"image", "splats"}};
  expect_finite(GetParam(), make, settings, gl ? 3 : 25);
}

INSTANTIATE_TEST_SUITE_P(Backends, Extremes, testing::Values("cpu", "gl"), [](const auto& p) { return p.param; });

}  // namespace

}  // namespace airlight
