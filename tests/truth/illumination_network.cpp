// Multiple scattering against random walks: the reference for one scattering, and for all orders above it an unbiased estimate of
// this test's own, whose standard error is taken off.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <string>
#include <thread>
#include <vector>

#include "app/airlight.h"
#include "common/reference/reference.h"
#include "tests/parity/inputs.h"
#include "tests/tolerances.h"

namespace airlight {
namespace {

constexpr Extent extent{12, 9};
constexpr double pi = 3.14159265358979323846;

// Optical depth 7.8 straight through; a lamp above and the sun.
Scene cloud(const Phase& phase) {
  Scene scene;
  scene.camera.position = {0, 0, 7};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.vertical_fov = 40;
  scene.camera.resolution = {extent.width, extent.height};
  scene.medium.phase = phase;
  const auto add = [&](const glm::dvec3& center, double radius, double extinction) {
    scene.medium.gaussians.push_back({.center = center, .radius = radius, .extinction = extinction, .albedo = glm::dvec3(0.9)});
  };
  add({-0.9, 0, 0}, 0.8, 2.2);
  add({0.7, 0.2, 0.3}, 0.9, 2);
  add({0, 0.8, -0.2}, 0.7, 2.5);
  add({-0.3, -0.6, 0.4}, 0.6, 2);
  add({0.9, -0.5, -0.5}, 0.6, 2.4);
  LightSource lamp, sun;
  lamp.position = {0.2, 2.4, 0.8};
  lamp.power = glm::dvec3(4);
  sun.type = LightType::directional;
  sun.direction = glm::normalize(glm::dvec3(0.7, -0.6, -0.4));
  sun.power = glm::dvec3(2.5);
  scene.lights = {lamp, sun};
  return scene;
}

class Walk {
 public:
  explicit Walk(const Scene& scene) : scene_(scene) {
    for (const Gaussian& g : scene.medium.gaussians) most_ += g.extinction;
  }

  // Light scattered twice or more that arrives from direction d at the camera, one sample.
  double sample(const glm::dvec3& d, std::uint32_t stream) {
    stream_ = stream, next_ = 0;
    glm::dvec3 p = scene_.camera.position + 3.5 * d, way = d;
    double weight = 1, sum = 0;
    for (int order = 1;; ++order) {
      do {
        p -= way * (std::log(1 - draw()) / most_);
        if (glm::length(p) > 5) return sum;  // nothing is there; the camera stands outside
      } while (draw() * most_ >= extinction(p));
      weight *= 0.9;
      if (order > 1) sum += weight * direct(p, way);
      if (weight < 0.2) {
        if (draw() < 0.5) return sum;
        weight *= 2;
      }
      way = scattered(way);
    }
  }

 private:
  double draw() { return uniform(stream_, next_++); }
  double g() const { return scene_.medium.phase.g; }
  double phase(double mu) const { return (1 - g() * g()) / (4 * pi * std::pow(1 + g() * g() - 2 * g() * mu, 1.5)); }

  double extinction(const glm::dvec3& p) const {
    double sum = 0;
    for (const Gaussian& one : scene_.medium.gaussians) {
      const glm::dvec3 e = p - one.center;
      sum += one.extinction * std::exp(-glm::dot(e, e) / (one.radius * one.radius));
    }
    return sum;
  }
  double transmittance(const glm::dvec3& p, const glm::dvec3& way, double length) const {
    double depth = 0;
    for (const Gaussian& one : scene_.medium.gaussians) {
      const glm::dvec3 e = one.center - p;
      const double foot = glm::dot(e, way), h2 = glm::dot(e, e) - foot * foot, r = one.radius;
      depth +=
          one.extinction * r * std::sqrt(pi) / 2 * std::exp(-h2 / (r * r)) * (std::erf((length - foot) / r) + std::erf(foot / r));
    }
    return std::exp(-depth);
  }
  // What p scatters of the lights against `way`.
  double direct(const glm::dvec3& p, const glm::dvec3& way) const {
    double sum = 0;
    for (const LightSource& light : scene_.lights) {
      const bool sun = light.type == LightType::directional;
      const glm::dvec3 e = sun ? -light.direction : light.position - p;
      const double length = sun ? 100 : glm::length(e);
      const glm::dvec3 toward = glm::normalize(e);
      sum += light.power.x / (sun ? 1 : length * length) * transmittance(p, toward, length) * phase(glm::dot(toward, way));
    }
    return sum;
  }
  glm::dvec3 scattered(const glm::dvec3& way) {
    double mu = 2 * draw() - 1;
    if (g() != 0) {
      const double q = (1 - g() * g()) / (1 + g() * mu);
      mu = (1 + g() * g() - q * q) / (2 * g());
    }
    const double angle = 2 * pi * draw(), s = std::sqrt(std::max(1 - mu * mu, 0.0));
    const glm::dvec3 beside = std::fabs(way.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 a = glm::normalize(glm::cross(beside, way)), b = glm::cross(way, a);
    return glm::normalize(mu * way + s * std::cos(angle) * a + s * std::sin(angle) * b);
  }

  const Scene& scene_;
  double most_ = 0;  // [1/m] extinction nowhere more
  std::uint32_t stream_ = 0, next_ = 0;
};

struct Truth {
  std::vector<double> values;
  double mean = 0, noise = 0;  // standard error, beside the mean
};

Truth truth_of(const Scene& scene, int samples) {
  NoProgress progress;
  const int threads = static_cast<int>(std::thread::hardware_concurrency());
  const ReferenceFrame once = reference_frame(scene, extent, {1e-6, true, Indirect::unbounded}, true, threads, progress);
  Truth truth;
  double squares = 0;
  Walk walk(scene);
  for (int j = 0; j < extent.height; ++j) {
    for (int i = 0; i < extent.width; ++i) {
      const double tangent = std::tan(scene.camera.vertical_fov * pi / 360);
      const glm::dvec3 d = glm::normalize(glm::dvec3((2 * (i + 0.5) / extent.width - 1) * tangent * extent.width / extent.height,
                                                     (1 - 2 * (j + 0.5) / extent.height) * tangent, -1));
      double sum = 0, sum2 = 0;
      for (int k = 0; k < samples; ++k) {
        const auto pixel = static_cast<std::uint32_t>(i + extent.width * j);
        const double value = walk.sample(d, 1000 + pixel * static_cast<std::uint32_t>(samples) + static_cast<std::uint32_t>(k));
        sum += value, sum2 += value * value;
      }
      const double mean = sum / samples;
      squares += std::max(sum2 / samples - mean * mean, 0.0) / samples;
      const auto number = static_cast<std::size_t>(i + extent.width * j);
      truth.values.push_back(mean + once.pixels[number].airlight.x);
      truth.mean += truth.values.back();
    }
  }
  const auto pixels = static_cast<double>(truth.values.size());
  truth.mean /= pixels;
  truth.noise = std::sqrt(squares / pixels) / truth.mean;
  return truth;
}

struct Compared {
  double apart, error, mean;  // relative RMSE; that without the walks' noise; image mean beside theirs
};

Compared compare(const Scene& scene, const Truth& truth, const char* particles, const char* directions) {
  Renderer renderer({.backend = "cpu"});
  RenderSettings settings;
  settings.technique = "illumination-network";
  settings.knobs = {{"particles", particles}, {"directions", directions}};
  const Frame frame = renderer.render(scene, settings);
  const HostImage& image = frame.image("beauty");
  double squares = 0, mean = 0;
  for (std::size_t k = 0; k < truth.values.size(); ++k) {
    const double value = static_cast<double>(image.values[3 * k]);
    squares += (value - truth.values[k]) * (value - truth.values[k]);
    mean += value / static_cast<double>(truth.values.size());
  }
  Compared c{};
  c.apart = std::sqrt(squares / static_cast<double>(truth.values.size())) / truth.mean;
  c.error = std::sqrt(std::max(c.apart * c.apart - truth.noise * truth.noise, 0.0));
  c.mean = mean / truth.mean;
  std::printf(
      "%s particles, %s directions: %.2f %% from walks known to %.2f %%, without their noise %.2f %%; mean %.4f of theirs\n",
      particles, directions, 100 * c.apart, 100 * truth.noise, 100 * c.error, c.mean);
  return c;
}

TEST(IlluminationNetworkTruth, Isotropic) {
  const Scene scene = cloud({});
  const Truth truth = truth_of(scene, 1000);
  const Compared coarse = compare(scene, truth, "1024", "128"), fine = compare(scene, truth, "4096", "256");
  EXPECT_FALSE(!(fine.error <= tolerance("truth_network")));
  EXPECT_LT(fine.apart, coarse.apart);
}

TEST(IlluminationNetworkTruth, Forward) {
  const Scene scene = cloud({PhaseKind::henyey_greenstein, 0.6});
  const Compared found = compare(scene, truth_of(scene, 700), "1024", "128");
  EXPECT_FALSE(!(std::fabs(found.mean - 1) <= tolerance("truth_network_forward")));
}

}  // namespace
}  // namespace airlight
