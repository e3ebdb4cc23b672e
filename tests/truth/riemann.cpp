// The reference against a plain sum over each ray that shares no code with it: a million steps, every triangle tried at each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <vector>

#include "tests/tolerances.h"
#include "tests/truth/plain_sums.h"
#include "tests/truth/truth_scenes.h"

namespace airlight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int steps = 1'000'000;

struct Sum {
  glm::dvec3 airlight{0}, surface{0};
  glm::dvec3 at_boundaries{0};  // what half a step is worth at each place where the shadow begins or ends
  int boundaries = 0;
};

Sum riemann_sum(const BruteForce& b, const glm::dvec3& d) {
  const Medium& medium = b.scene.medium;
  const glm::dvec3 eye = b.scene.camera.position;
  double length = b.scene.sky_distance;
  const Corners* seen = nullptr;
  for (const Corners& t : b.triangles) {
    const double at = meets(eye, d, t);
    if (at > 0 && at < length) length = at, seen = &t;
  }

  Sum sum;
  const double step = length / steps;
  double depth = 0;  // from the eye to the step's beginning
  bool was_lit = true;
  for (int i = 0; i < steps; ++i) {
    const glm::dvec3 x = eye + (i + 0.5) * step * d;
    double extinction = medium.extinction;
    glm::dvec3 scattering = medium.extinction * medium.albedo, source(0);
    for (const Gaussian& g : medium.gaussians) {
      const double share = b.density(g, x);
      extinction += g.extinction * share;
      scattering += g.extinction * share * g.albedo;
      source += share * g.emission;
    }
    const double seen_through = std::exp(-(depth + extinction * step / 2));
    depth += extinction * step;
    source += extinction * medium.ambient;
    const double g = medium.phase.g, mu = glm::dot(glm::normalize(x - b.light.position), -d);
    const double phase = (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * mu, 1.5));
    const glm::dvec3 scattered = phase * b.arriving(x) * seen_through * step * scattering * b.light.power;
    const bool lit = b.lit(x);
    sum.airlight += seen_through * step * source;
    if (lit) sum.airlight += scattered;
    if (i > 0 && lit != was_lit) {
      sum.at_boundaries += 0.5 * scattered;
      ++sum.boundaries;
    }
    was_lit = lit;
  }

  if (!seen) {
    sum.surface = std::exp(-depth) * b.scene.background;
    return sum;
  }
  const glm::dvec3 x = eye + length * d;
  glm::dvec3 normal = glm::normalize(glm::cross(seen->b - seen->a, seen->c - seen->a));
  if (glm::dot(normal, d) > 0) normal = -normal;
  const glm::dvec3 rho(b.scene.surfaces[0].material.diffuse);
  const double cosine = glm::dot(normal, glm::normalize(b.light.position - x));
  sum.surface = rho * medium.ambient;
  if (cosine > 0 && b.lit(x)) sum.surface += rho / pi * cosine * b.arriving(x) * b.light.power;
  sum.surface *= std::exp(-depth);
  return sum;
}

TEST(Riemann, GaussiansBehindBox) {
  const Scene scene = gaussians_behind_box();
  ASSERT_EQ(scene.medium.phase.kind, PhaseKind::henyey_greenstein);
  const BruteForce brute_force(scene);
  const Reference reference(scene, {1e-11, true});
  constexpr Extent extent{160, 120};
  int with_shadow = 0, on_the_box = 0;
  for (const glm::dvec2 at : {glm::dvec2(80.5, 60.5),
                              {70.5, 75.5},
                              {95.5, 80.5},
                              {60.5, 45.5},
                              {85.5, 48.5},
                              {30.5, 100.5},
                              {66.5, 35.5},
                              {110.5, 90.5}}) {
    const Sum sum = riemann_sum(brute_force, brute_force.direction(at, extent));
    const ReferencePixel pixel = reference.pixel(at, extent);
    double worst = 0, allowed = 0;
    for (int c = 0; c < 3; ++c) {
      const double bound = sum.at_boundaries[c] / sum.airlight[c] + tolerance("riemann_sum");
      const double error = std::fabs(pixel.airlight[c] - sum.airlight[c]) / sum.airlight[c];
      EXPECT_FALSE(!(error <= bound)) << at.x << ", " << at.y << ": airlight " << pixel.airlight[c] << " instead of "
                                      << sum.airlight[c];
      const double surface_error = std::fabs(pixel.surface[c] - sum.surface[c]) / sum.surface[c];
      EXPECT_FALSE(!(surface_error <= tolerance("riemann_sum")))
          << at.x << ", " << at.y << ": surface " << pixel.surface[c] << " instead of " << sum.surface[c];
      worst = std::max({worst, error, surface_error});
      allowed = std::max(allowed, bound);
    }
    with_shadow += sum.boundaries > 0;
    on_the_box += pixel.surface_index >= 0;
    std::printf("pixel %5.1f %5.1f: %s, %d shadow boundaries, relative error %.2g (at most %.2g)\n", at.x, at.y,
                pixel.surface_index >= 0 ? "box" : "sky", sum.boundaries, worst, allowed);
  }
  EXPECT_GE(with_shadow, 4);
  EXPECT_GE(on_the_box, 1);
}

}  // namespace
}  // namespace airlight
