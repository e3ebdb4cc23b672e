// Noise that bends view rays: what is widened misses none, none costs nothing, it stands still in the world, and who refuses it.
#include "common/plan/ray_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "app/airlight.h"
#include "common/formulas/double.h"
#include "common/techniques/technique.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

Scene noisy(double amplitude) {
  Scene scene = test_scene(600);
  scene.surfaces.resize(1);
  scene.medium.extinction = 0.02;
  scene.medium.gaussians = {{.center = {0.2, 0.4, 0}, .radius = 0.9, .extinction = 0.6},
                            {.center = {-0.8, 0.1, 0.5}, .radius = 0.6, .extinction = 0.9}};
  scene.medium.noise = {.amplitude = amplitude, .scale = 0.3, .offset = {1, 2, 3}};
  return scene;
}

Frame rendered(const Scene& scene) {
  Renderer renderer({.backend = "cpu"});
  RenderSettings settings;
  settings.technique = "gaussian-airlight";
  settings.resolution = Extent{76, 57};
  settings.images = {"beauty", "transmittance"};
  return renderer.render(scene, settings);
}

// Places of bent rays within a Gaussian's reach are within the widened one of the rays themselves.
TEST(RayNoise, WhatIsWidenedMissesNone) {
  std::uint32_t next = 0;
  const auto number = [&](double from, double to) { return from + (to - from) * uniform(310, next++); };
  const auto direction = [&] {
    const double z = number(-1, 1), a = number(0, 6.283), r = std::sqrt(1 - z * z);
    return glm::dvec3(r * std::cos(a), r * std::sin(a), z);
  };
  int within = 0, outside = 0;
  double nearest = 1;  // of the room that is left, beside the reach
  for (int i = 0; i < 4000; ++i) {
    GaussianDensity g;
    g.center = direction() * std::exp(number(-4, 4));
    g.radius = static_cast<float>(std::exp(number(-2, 2)));
    g.reach = 3 * g.radius;
    const RayNoise noise{.amplitude = static_cast<float>(number(0, 1)),
                         .scale = static_cast<float>(number(0.1, 2)),
                         .offset = {number(0, 256), number(0, 256), number(0, 256)}};
    std::vector<GaussianDensity> wide{g};
    widen(wide, noise);
    const glm::dvec3 c(g.center);
    const double reach = static_cast<double>(g.reach), widened = static_cast<double>(wide[0].reach), far = glm::length(c);
    EXPECT_GE(widened, reach);
    for (int k = 0; k < 8; ++k) {
      const glm::dvec3 d = glm::normalize(c / far + direction() * number(0, 4) * reach / far);
      glm::dvec3 way;
      f64::bent_ray(d.x, d.y, d.z, c.x, c.y, c.z, static_cast<double>(g.radius), static_cast<double>(noise.amplitude),
                    1 / static_cast<double>(noise.scale), static_cast<double>(noise.offset.x),
                    static_cast<double>(noise.offset.y), static_cast<double>(noise.offset.z), way.x, way.y, way.z);
      const double t = std::max(0.0, glm::dot(c, way) + number(-1, 1) * reach);
      if (glm::length(t * way - c) >= reach) continue;
      const double off = glm::length(t * d - c);
      EXPECT_LT(off, widened);
      ++within;
      outside += off > reach ? 1 : 0;
      nearest = std::min(nearest, (widened - off) / reach);
    }
  }
  std::printf("%d places of bent rays within reach, %d of them beyond it on the ray itself; room of %.3f reaches left\n", within,
              outside, nearest);
  EXPECT_GT(outside, 20) << "without widening, something would be missed";
}

TEST(RayNoise, NoneLeavesEveryBit) {
  Scene plain = noisy(0);
  plain.medium.noise = {};
  const Frame without = rendered(plain), none = rendered(noisy(0)), some = rendered(noisy(0.5));
  for (const char* name : {"beauty", "transmittance"}) {
    EXPECT_EQ(none.image(name).values, without.image(name).values) << name;
    EXPECT_NE(some.image(name).values, without.image(name).values) << name;
  }
  Scene fog = noisy(0.5);
  fog.medium.gaussians.clear();
  plain.medium.gaussians.clear();
  EXPECT_EQ(rendered(fog).image("beauty").values, rendered(plain).image("beauty").values);
  RenderSettings settings;
  settings.technique = "gaussian-airlight";
  EXPECT_NE(explain(fog, settings).find("noise: no Gaussians"), std::string::npos) << explain(fog, settings);
}

// It repeats after 256 cells, and moves with its offset as if the scene were moved the other way.
TEST(RayNoise, StandsStillInTheWorld) {
  const Scene scene = noisy(0.5);
  Scene moved = scene;
  const glm::dvec3 by(0.6, -0.9, 0.3);  // whole cells: an offset of 2, -3, 1
  moved.camera.position += by;
  moved.camera.look_at += by;
  for (Gaussian& g : moved.medium.gaussians) g.center += by;
  for (LightSource& light : moved.lights) light.position += by;
  for (Surface& s : moved.surfaces) s.transform[3] += glm::dvec4(by, 0);
  const auto apart = [&](const Scene& other) {
    const Frame one = rendered(scene), two = rendered(other);
    const std::vector<float>&a = one.image("transmittance").values, &b = two.image("transmittance").values;
    float worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] - b[i]));
    return worst;
  };
  EXPECT_GT(apart(moved), 0.01F) << "the scene has moved through the noise";
  moved.medium.noise.offset -= glm::dvec3(2, -3, 1);
  EXPECT_LT(apart(moved), 1e-4F) << "the noise has moved with it";
  moved.medium.noise.offset += glm::dvec3(256, -512, 256);
  EXPECT_LT(apart(moved), 1e-4F) << "by whole periods";
}

TEST(RayNoise, IsRefusedByNameWhereNoRayIsBent) {
  for (const Technique& t : techniques()) {
    if (t.name == "shadow-planes") continue;  // it refuses the Gaussians
    const auto why = t.refuses(noisy(0.5));
    EXPECT_EQ(why.has_value(), t.name != "gaussian-airlight") << t.name;
    EXPECT_EQ(why.value_or("").find("noise") != std::string::npos, t.name != "gaussian-airlight") << why.value_or("");
    EXPECT_FALSE(t.refuses(noisy(0)).has_value()) << t.name;
  }
}

}  // namespace

}  // namespace airlight
