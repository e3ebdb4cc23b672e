// The published airlight is what its equations say: beside them in double, every sum over all Gaussians, by the C library.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/airlight.h"
#include "tests/tolerances.h"
#include "tests/truth/gaussian_scenes.h"
#include "tests/truth/plain_sums.h"

namespace airlight {
namespace {

constexpr double pi = std::numbers::pi;

// Zhou et al. 2007, eq. 31: of one Gaussian between two places.
double line_integral(const Gaussian& g, const glm::dvec3& from, const glm::dvec3& to) {
  const double length = glm::length(to - from);
  if (!(length > 0)) return 0;
  const glm::dvec3 way = (to - from) / length, center = g.center - from;
  const double foot = glm::dot(way, center), h = glm::length(glm::cross(way, center));
  return g.extinction * g.radius * std::sqrt(pi) / 2 * std::exp(-h * h / (g.radius * g.radius)) *
         (std::erf((length - foot) / g.radius) + std::erf(foot / g.radius));
}

struct Published {
  const Scene& scene;
  std::vector<double> to_camera;  // of the other Gaussians and the fog, of each centre
  std::vector<std::vector<double>> to_light;

  // Where a light's way to a place begins.
  static glm::dvec3 origin(const LightSource& light, const glm::dvec3& place) {
    return light.type == LightType::directional ? place - 1e5 * light.direction : light.position;
  }
  double fog(const LightSource& light, const glm::dvec3& place) const {
    return light.type == LightType::directional ? 0 : scene.medium.extinction * glm::length(place - light.position);
  }
  double phase(double mu) const {
    const double g = scene.medium.phase.g;  // Henyey and Greenstein 1941; isotropic where it is 0
    return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * mu, 1.5));
  }
  // Light that arrives at a place, scattered toward the camera, through nothing.
  double density(const LightSource& light, const glm::dvec3& place, const glm::dvec3& view) const {
    if (light.type == LightType::directional) return phase(-glm::dot(light.direction, view));
    const glm::dvec3 way = place - light.position;
    return phase(-glm::dot(glm::normalize(way), view)) / glm::dot(way, way);
  }

  explicit Published(const Scene& s) : scene(s), to_light(s.lights.size()) {
    const std::vector<Gaussian>& all = s.medium.gaussians;
    const auto others = [&](std::size_t i, const glm::dvec3& from) {
      double sum = 0;
      for (std::size_t j = 0; j < all.size(); ++j) sum += j == i ? 0 : line_integral(all[j], from, all[i].center);
      return sum;
    };
    for (std::size_t i = 0; i < all.size(); ++i) {
      const glm::dvec3& center = all[i].center;
      to_camera.push_back(others(i, s.camera.position) + s.medium.extinction * glm::length(center - s.camera.position));
      for (std::size_t k = 0; k < s.lights.size(); ++k)
        to_light[k].push_back(others(i, origin(s.lights[k], center)) + fog(s.lights[k], center));
    }
  }

  // Of one ray, without emission and ambient light.
  glm::dvec3 airlight(const glm::dvec3& d, double length) const {
    const glm::dvec3 eye = scene.camera.position;
    glm::dvec3 sum(0);
    for (std::size_t k = 0; k < scene.lights.size(); ++k) {
      const LightSource& light = scene.lights[k];
      for (std::size_t i = 0; i < scene.medium.gaussians.size(); ++i) {
        const Gaussian& g = scene.medium.gaussians[i];
        const glm::dvec3 place = eye + d * std::clamp(glm::dot(d, g.center - eye), 0.0, length);  // eq. 10
        const double own = line_integral(g, origin(light, place), place) + line_integral(g, eye, place);
        sum += light.power * g.albedo * line_integral(g, eye, eye + d * length) * density(light, place, d) *
               std::exp(-own - to_camera[i] - to_light[k][i]);  // eq. 11 to 13
      }
      double fog_alone = 0;  // eq. 14 and 15, by midpoints
      const int n = scene.medium.extinction > 0 ? 40000 : 0;
      for (int j = 0; j < n; ++j) {
        const double t = (j + 0.5) * length / n;
        const glm::dvec3 place = eye + d * t;
        fog_alone += length / n * density(light, place, d) * std::exp(-scene.medium.extinction * t - fog(light, place));
      }
      double between = 0;  // eq. 16
      for (const Gaussian& g : scene.medium.gaussians) between += line_integral(g, eye, origin(light, eye));
      sum += light.power * scene.medium.albedo * scene.medium.extinction * fog_alone * std::exp(-between);
    }
    return sum;
  }
};

class ProjectedGaussiansTruth : public testing::TestWithParam<std::string> {};

TEST_P(ProjectedGaussiansTruth, AreTheEquations) {
  const auto scenes = gaussian_scenes();
  const auto found = std::find_if(scenes.begin(), scenes.end(), [](const TruthScene& s) { return s.name == GetParam(); });
  ASSERT_NE(found, scenes.end());
  Scene scene = found->make();
  scene.medium.emission = scene.medium.ambient = glm::dvec3(0);
  scene.camera.resolution = {8, 6};
  RenderSettings settings;
  settings.technique = "gaussian-airlight";
  settings.knobs = {{"light_path", "published"}, {"lost_depth", "1e-5"}};  // the equations leave nothing out
  settings.images = {"airlight", "depth"};
  for (const char* backend : {"cpu", "gl"}) {
    Renderer renderer({.backend = backend});
    const Frame frame = renderer.render(scene, settings);
    const HostImage& image = frame.image("airlight");
    const Published published(scene);
    const BruteForce rays(scene);
    double largest = 0, error = 0;
    for (int y = 0; y < image.extent.height; ++y) {
      for (int x = 0; x < image.extent.width; ++x) {
        const auto depth = static_cast<double>(frame.image("depth").at(x, y));
        const glm::dvec3 truth = published.airlight(rays.direction({x + 0.5, y + 0.5}, image.extent),
                                                    depth < 1e30 ? depth : std::min(scene.sky_distance, 1e5));
        for (int c = 0; c < 3; ++c) {
          largest = std::max(largest, truth[c]);
          error = std::max(error, std::fabs(static_cast<double>(image.at(x, y, c)) - truth[c]));
        }
      }
    }
    std::printf("%s: at most %.2e beside the largest, %.3g\n", frame.device.c_str(), error / largest, largest);
    EXPECT_FALSE(!(error <= tolerance("published_equations") * largest));
  }
}

INSTANTIATE_TEST_SUITE_P(Truth, ProjectedGaussiansTruth,
                         testing::Values("one_blob", "eight_blobs", "blobs_in_fog", "valley", "camera_in_blob",
                                         "blobs_behind_camera", "pierced_tube"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace airlight
