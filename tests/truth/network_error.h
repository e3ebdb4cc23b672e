// What the technique illumination-network is apart from the reference's random paths, for tests and airlight-network.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <thread>
#include <vector>

#include "app/airlight.h"
#include "common/reference/optical_depth.h"
#include "common/reference/reference.h"
#include "tests/truth/scenes.h"

namespace airlight {

// Five Gaussians under a lamp and the sun, of this optical depth along the thickest line from side to side.
inline Scene network_cloud(double depth, double albedo, double g) {
  Scene scene;
  scene.camera = {.position = {0, 0, 7}, .look_at = {0, 0, 0}, .vertical_fov = 40};
  if (g != 0) scene.medium.phase = {PhaseKind::henyey_greenstein, g};
  scene.medium.gaussians = {{.center = {-0.9, 0, 0}, .radius = 0.8, .extinction = 2.2},
                            {.center = {0.7, 0.2, 0.3}, .radius = 0.9, .extinction = 2},
                            {.center = {0, 0.8, -0.2}, .radius = 0.7, .extinction = 2.5},
                            {.center = {-0.3, -0.6, 0.4}, .radius = 0.6, .extinction = 2},
                            {.center = {0.9, -0.5, -0.5}, .radius = 0.6, .extinction = 2.4}};
  double as_they_are = 0;
  for (int i = 0; i < 64 * 64; ++i) {
    const glm::dvec3 from(-9, 0.05 * (i % 64 - 31.5), 0.05 * (i / 64 - 31.5));
    as_they_are = std::max(as_they_are, optical_depth(scene.medium.gaussians, from, {1, 0, 0}, 100));
  }
  for (Gaussian& one : scene.medium.gaussians) one.extinction *= depth / as_they_are, one.albedo = glm::dvec3(albedo);
  scene.lights = {point_light({0.2, 2.4, 0.8}, glm::dvec3(4)), directional_light({0.7, -0.6, -0.4}, glm::dvec3(2.5))};
  return scene;
}

// Two small clouds so far from each other, the camera before one of them.
inline Scene small_clouds(const glm::dvec3& apart) {
  Scene scene;
  scene.camera = {.position = {0, 0, 0.4}, .look_at = {0, 0, 0}, .vertical_fov = 40};
  for (const double k : {0.0, 1.0})
    scene.medium.gaussians.push_back({.center = k * apart, .radius = 0.05, .extinction = 60, .albedo = glm::dvec3(0.9)});
  scene.lights = {directional_light({0.7, -0.6, -0.4}, glm::dvec3(2.5))};
  return scene;
}

// A ball of so many equal Gaussians, each as wide as the next are away, of an optical depth of about 5 through its middle.
inline Scene particle_cloud(int count) {
  Scene scene;
  scene.camera = {.position = {0, 0, 5}, .look_at = {0, 0, 0}, .vertical_fov = 32};
  const double radius = std::cbrt(4 * M_PI / 3 / count);
  std::vector<Gaussian>& all = scene.medium.gaussians;
  for (int k = 0; static_cast<int>(all.size()) < count; ++k) {
    // Roberts 2018
    const glm::dvec3 at =
        2.0 * glm::fract(0.5 + static_cast<double>(k) * glm::dvec3(0.8191725133961645, 0.6710436067037893, 0.5497004779019703)) -
        1.0;
    if (glm::length(at) < 1) all.push_back({.center = at, .radius = radius, .albedo = glm::dvec3(0.9)});
  }
  for (Gaussian& one : all) one.extinction = 2.5 * 4 * M_PI / 3 / count / std::pow(M_PI, 1.5) / std::pow(radius, 3);
  scene.lights = {point_light({0.2, 2.4, 0.8}, glm::dvec3(4)), directional_light({0.7, -0.6, -0.4}, glm::dvec3(2.5))};
  return scene;
}

// All orders of scattering; everything is gray, one channel stands for all.
struct NetworkTruth {
  Extent extent;
  std::vector<double> values;
  double mean = 0, single = 0;               // of the image, and of what is scattered once
  double noise = 0;                          // standard error of a pixel, root of the mean square, beside the mean
  double seconds_once = 0, seconds_all = 0;  // what it took, with and without paths, on `threads`
  int paths = 0, threads = 0;
};

inline NetworkTruth network_truth(const Scene& scene, Extent extent, int paths) {
  NetworkTruth truth;
  truth.extent = extent, truth.paths = paths, truth.threads = static_cast<int>(std::thread::hardware_concurrency());
  NoProgress progress;
  const auto rendered = [&](int max_bounces, double& seconds) {
    ReferenceSettings settings;
    settings.tolerance = 1e-6, settings.max_bounces = max_bounces, settings.paths = paths;
    settings.single_by_paths = scene.environment.has_value();  // its quadrature takes long
    const auto start = std::chrono::steady_clock::now();
    const ReferenceFrame frame = reference_frame(scene, extent, settings, false, truth.threads, progress);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return frame;
  };
  const ReferenceFrame once = rendered(1, truth.seconds_once), all = rendered(1000000, truth.seconds_all);
  const auto pixels = static_cast<double>(all.pixels.size());
  for (std::size_t i = 0; i < all.pixels.size(); ++i) {
    const double value = all.pixels[i].airlight.x, error = all.pixels[i].standard_error.x;
    truth.values.push_back(value);
    truth.mean += value / pixels, truth.single += once.pixels[i].airlight.x / pixels, truth.noise += error * error / pixels;
  }
  truth.noise = std::sqrt(truth.noise) / truth.mean;
  return truth;
}

struct NetworkError {
  double apart = 0;  // relative RMSE: the network's error and the truth's noise
  double error = 0;  // the noise taken off
  double mean = 0;   // of the image beside the truth's: 1 without bias
};

struct NetworkSize {
  int particles = 0, directions = 0, resolution = 0;  // none: the technique's own
  std::string set = "fibonacci", particle_set = "sampled";
};

inline RenderSettings network_settings(const NetworkSize& size, Extent extent) {
  RenderSettings settings;
  settings.technique = "illumination-network";
  if (size.particles > 0) {
    settings.knobs = {{"particles", std::to_string(size.particles)},
                      {"directions", std::to_string(size.directions)},
                      {"resolution", std::to_string(size.resolution)},
                      {"direction_set", size.set},
                      {"particle_set", size.particle_set}};
  }
  settings.resolution = extent;
  return settings;
}

// `seen`: the knob `image`.
inline NetworkError network_error(const Scene& scene, const NetworkTruth& truth, const NetworkSize& size,
                                  const std::string& seen = "source") {
  Renderer renderer({.backend = "cpu"});
  RenderSettings settings = network_settings(size, truth.extent);
  settings.images = {"airlight"};
  settings.knobs.emplace_back("image", seen);
  const Frame frame = renderer.render(scene, settings);
  const HostImage& image = frame.image("airlight");
  double squares = 0, mean = 0;
  const auto pixels = static_cast<double>(truth.values.size());
  for (std::size_t k = 0; k < truth.values.size(); ++k) {
    const auto value = static_cast<double>(image.values[3 * k]);
    squares += (value - truth.values[k]) * (value - truth.values[k]) / pixels;
    mean += value / pixels;
  }
  NetworkError e;
  e.apart = std::sqrt(squares) / truth.mean;
  e.error = std::sqrt(std::max(e.apart * e.apart - truth.noise * truth.noise, 0.0));
  e.mean = mean / truth.mean;
  return e;
}

}  // namespace airlight
