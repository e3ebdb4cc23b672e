// What the reference says of light that scatters once on its way to surfaces, where surfaces end and shadow it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "common/reference/indirect.h"
#include "common/reference/reference.h"
#include "common/relative_rmse.h"
#include "tests/tolerances.h"
#include "tests/truth/plain_sums.h"
#include "tests/truth/scenes.h"
#include "tests/truth/shadow_scenes.h"

namespace airlight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr ReferenceParts surfaces_alone{true, false};

ReferenceSettings settings(Indirect indirect, double tolerance) {
  ReferenceSettings s;
  s.indirect = indirect, s.indirect_tolerance = tolerance;
  return s;
}

Surface square_floor(double half, const Material& material) {
  Mesh mesh;
  add_parallelogram(mesh, {-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half});
  return surface(std::move(mesh), material, true);
}

// The camera looks down at a floor that hides nothing from the half space above it: both models are one there. Of the lobe as
// well, which the view keeps off the horizon.
TEST(ExactIndirect, IsTheUnboundedOneInAnOpenHalfSpace) {
  Scene scene = foggy_scene(0.2);
  scene.medium.albedo = {0.9, 0.8, 0.7};
  scene.camera = {.position = {0.4, 2.5, 0.6}, .look_at = {0, 0, 0}, .vertical_fov = 30};
  Material glossy = diffuse(0.5F, 0.4F, 0.3F);
  glossy.specular = glm::vec3(0.3F), glossy.shininess = 60;
  double worst = 0;
  for (const Phase& phase : {Phase{}, Phase{PhaseKind::henyey_greenstein, 0.6}, Phase{PhaseKind::henyey_greenstein, -0.95}}) {
    // A radius of the lamp is what the unbounded model does not know: here it is next to nothing.
    for (const LightSource& light :
         {point_light({0.9, 1.7, -0.5}, {10, 9, 8}, 1e-9), directional_light({0.3, -1, 0.2}, {1, 2, 3})}) {
      for (const Material& material : {diffuse(0.5F, 0.4F, 0.3F), glossy}) {
        scene.medium.phase = phase, scene.lights = {light}, scene.surfaces = {square_floor(5, material)};
        const ReferencePixel exact = Reference(scene, settings(Indirect::exact, 1e-5)).pixel(centre, one_pixel, surfaces_alone);
        const ReferencePixel open = Reference(scene, settings(Indirect::unbounded, 0)).pixel(centre, one_pixel, surfaces_alone);
        for (int c = 0; c < 3; ++c) {
          ASSERT_GT(open.surface_indirect[c], 0);
          worst = std::max(worst, std::fabs(exact.surface_indirect[c] / open.surface_indirect[c] - 1));
        }
      }
    }
  }
  std::printf("relative difference at most %.2g\n", worst);
  EXPECT_FALSE(!(worst <= tolerance("indirect_open")));
}

// From below a caster without thickness, and behind it, no light of a lamp above arrives, however scattered.
TEST(ExactIndirect, NothingComesThroughTheFloor) {
  Scene scene = foggy_scene(0.2);
  scene.camera = {.position = {0.4, -2.5, 0.6}, .look_at = {0, 0, 0}};
  scene.lights = {point_light({0.9, 1.7, -0.5}, {10, 9, 8})};
  scene.surfaces = {square_floor(1e6, diffuse(0.5F, 0.4F, 0.3F))};
  const auto of = [&](Indirect indirect) {
    return Reference(scene, settings(indirect, 1e-3)).pixel(centre, one_pixel, surfaces_alone).surface_indirect.x;
  };
  EXPECT_GT(of(Indirect::unbounded), 0);
  EXPECT_LT(of(Indirect::exact), 1e-9 * of(Indirect::unbounded));
}

// Light that scatters back arrives as light that scatters forward does of a sun that shines the other way.
TEST(IndirectLobe, TurnsWithThePhaseFunction) {
  double worst = 0;
  for (const PhaseKind kind : {PhaseKind::henyey_greenstein, PhaseKind::cornette_shanks}) {
    for (const double g : {0.3, 0.9, 0.99}) {
      for (const double exponent : {1.0, 30.0, 1000.0}) {
        double top = 0, apart = 0;
        for (const double phi : {0.0, 0.01, 0.3, 1.3, pi / 2, 1.8, 2.9, pi}) {
          const double forward = indirect_lobe({kind, g}, true, 0, phi, exponent);
          top = std::max(top, forward);
          apart = std::max(apart, std::fabs(indirect_lobe({kind, -g}, true, 0, pi - phi, exponent) - forward));
        }
        worst = std::max(worst, apart / top);
      }
    }
  }
  std::printf("beside the largest at most %.2g\n", worst);
  EXPECT_FALSE(!(worst <= tolerance("indirect_open")));
}

// The van der Corput sequence: i-th number of the low-discrepancy sequence in a base.
double radical_inverse(std::uint32_t i, std::uint32_t base) {
  double value = 0, digit = 1;
  for (; i > 0; i /= base) value += (i % base) * (digit /= base);
  return value;
}

// The rendering equation as an integral over space, whose two poles are shared out: the part r^2 / (r^2 + d^2) of a place r from
// the lamp and d from the surface point in spherical coordinates about the point, the rest about the lamp. Then nothing is
// unbounded, and numbers of Halton's sequence do. Directional lights would need another share.
glm::dvec3 plain_indirect(const BruteForce& b, const glm::dvec3& at, const glm::dvec3& normal, const glm::dvec3& view,
                          const Material& material, std::uint32_t samples) {
  const Medium& medium = b.scene.medium;
  const double sigma = medium.extinction, g = medium.phase.g;
  const glm::dvec3 mirror = view - 2 * glm::dot(view, normal) * normal;
  const glm::dvec3 above = at + 1e-7 * normal;
  const auto n = static_cast<double>(material.shininess);
  glm::dvec3 sum(0);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const double z = 2 * radical_inverse(i + 1, 2) - 1, angle = 2 * pi * radical_inverse(i + 1, 3);
    const double distance = -std::log(1 - radical_inverse(i + 1, 5)) / sigma;
    const double s = std::sqrt(1 - z * z);
    const glm::dvec3 way = distance * glm::dvec3(s * std::cos(angle), z, s * std::sin(angle));
    const double volume = 4 * pi * std::exp(sigma * distance) / sigma;  // over distance^2
    for (const glm::dvec3& centre_of : {at, b.light.position}) {
      const glm::dvec3 x = centre_of + way;
      const glm::dvec3 to = x - at;
      const double d = glm::length(to), r = glm::distance(x, b.light.position), cosine = glm::dot(normal, to) / d;
      if (!(cosine > 0) || !b.sees(above, x) || !b.lit(x)) continue;
      glm::dvec3 scattering = sigma * medium.albedo;
      for (const Gaussian& one : medium.gaussians) scattering += one.extinction * b.density(one, x) * one.albedo;
      const double mu = glm::dot((x - b.light.position) / r, -to / d);
      const double phase = (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * mu, 1.5));
      const double lobe = std::max(0.0, glm::dot(mirror, to) / d);
      const glm::dvec3 reflection =
          cosine / pi * glm::dvec3(material.diffuse) + (n + 1) / (2 * pi) * std::pow(lobe, n) * glm::dvec3(material.specular);
      // Of the two poles, one went with the volume and one with the share.
      sum += phase * std::exp(-b.depth(at, x) - b.depth_to_light(x)) * volume / (r * r + d * d) * scattering * reflection;
    }
  }
  return sum / static_cast<double>(samples) * b.light.power;
}

Scene box_on_floor() {
  Scene scene = foggy_scene(0.25);
  scene.medium.phase = {PhaseKind::henyey_greenstein, 0.4};
  scene.medium.albedo = {1, 0.8, 0.6};
  scene.camera.position = {1.5, 2, 3};
  scene.lights = {point_light({-0.7, 1.6, -0.4}, {10, 9, 8}, 1e-6)};
  scene.surfaces = {square_floor(20, diffuse(0.5F, 0.4F, 0.3F)),
                    surface(box({-0.5, 0.02, -0.5}, {0.5, 1, 0.5}), diffuse(0.5F, 0.4F, 0.3F), true)};
  return scene;
}

// At the box's foot in its shadow, on its lit top; in the light, in the umbra, on its dark side. A million places agree to 1e-3.
TEST(ExactIndirect, IsAPlainSumOverSpace) {
  double worst = 0;
  for (const int variant : {0, 1, 2}) {
    Scene scene = box_on_floor();
    Material& material = scene.surfaces[0].material;
    if (variant == 1) material.specular = glm::vec3(0.4F), material.shininess = 8;
    if (variant == 2)
      scene.medium.gaussians = {{.center = {0.3, 0.9, 0.9}, .radius = 0.5, .extinction = 1.5, .albedo = {0.5, 1, 1}}};
    scene.surfaces[1].material = material;
    std::vector<glm::dvec3> targets{{0.55, 0, 0.1}, {0.2, 1, 0.1}};
    if (variant == 0) targets.insert(targets.end(), {{-1.5, 0, 0.3}, {1.1, 0, 0.4}, {0.5, 0.3, 0.2}});
    for (const glm::dvec3& target : targets) {
      scene.camera.look_at = target;
      const ReferencePixel pixel = Reference(scene, settings(Indirect::exact, 1e-2)).pixel(centre, one_pixel, surfaces_alone);
      const BruteForce b(scene);
      const glm::dvec3 view = b.direction(centre, one_pixel), at = scene.camera.position + pixel.depth * view;
      const glm::dvec3 expected = pixel.transmittance * plain_indirect(b, at, pixel.normal, view, material, 40000);
      double error = 0;
      for (int c = 0; c < 3; ++c) error = std::max(error, std::fabs(pixel.surface_indirect[c] / expected[c] - 1));
      std::printf("variant %d at (%.2f, %.2f, %.2f): %.6g instead of %.6g, relative error %.2g, claimed %.2g\n", variant, at.x,
                  at.y, at.z, pixel.surface_indirect.x, expected.x, error,
                  pixel.error * pixel.surface.x / pixel.surface_indirect.x);
      worst = std::max(worst, error);
    }
  }
  EXPECT_FALSE(!(worst <= tolerance("indirect_plain_sum")));
}

// Asked for less, it errs by no more than it claims.
TEST(ExactIndirect, ErrsByNoMoreThanItClaims) {
  Scene scene = box_on_floor();
  for (const glm::dvec3& target : {glm::dvec3(-1.5, 0, 0.3), glm::dvec3(0.55, 0, 0.1), glm::dvec3(0.5, 0.3, 0.2)}) {
    scene.camera.look_at = target;
    const auto of = [&](double tolerance) {
      return Reference(scene, settings(Indirect::exact, tolerance)).pixel(centre, one_pixel, surfaces_alone);
    };
    const double truth = of(1e-4).surface_indirect.x;
    for (const double asked : {1e-1, 1e-2, 1e-3}) {
      const ReferencePixel pixel = of(asked);
      const double claimed = pixel.error * pixel.surface.x / pixel.surface_indirect.x;
      const double error = std::fabs(pixel.surface_indirect.x / truth - 1);
      std::printf("asked for %.0e: error %.2g, claimed %.2g\n", asked, error, claimed);
      EXPECT_FALSE(!(claimed <= asked));
      EXPECT_FALSE(!(error <= claimed + 1e-4));
    }
  }
}

// How far the model that the techniques share is from what there is, of indirect light and of the whole picture. It leaves out
// nothing but what takes light away, so that no pixel is darker in it.
void compare_models(const TruthScene& of, Extent extent, double tolerance) {
  const Scene scene = of.make();
  NoProgress progress;
  const ReferenceFrame exact = reference_frame(scene, extent, settings(Indirect::exact, tolerance), false, 2, progress);
  const ReferenceFrame open = reference_frame(scene, extent, settings(Indirect::unbounded, 0), false, 2, progress);
  RelativeRmse indirect, beauty;
  double sum = 0, of_open = 0, share = 0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    const ReferencePixel &a = open.pixels[i], &b = exact.pixels[i];
    for (int c = 0; c < 3; ++c) {
      indirect.add(a.surface_indirect[c], b.surface_indirect[c]);
      beauty.add(a.beauty()[c], b.beauty()[c]);
      sum += b.surface_indirect[c], of_open += a.surface_indirect[c], share += b.beauty()[c];
      EXPECT_LE(b.surface_indirect[c], a.surface_indirect[c] * (1 + 2 * tolerance)) << i;
    }
  }
  std::printf(
      "%s: indirect light is %.1f %% of beauty; unbounded, it is %.0f %% brighter, relative RMSE %.0f %%, of beauty %.2f %%\n",
      std::string(of.name).c_str(), 100 * sum / share, 100 * (of_open / sum - 1), 100 * indirect.value(), 100 * beauty.value());
  EXPECT_GT(beauty.value(), 1e-4);  // surfaces do shadow here
}

class IndirectModels : public testing::TestWithParam<TruthScene> {};
TEST_P(IndirectModels, UnboundedBesideExact) { compare_models(GetParam(), {3, 2}, 5e-2); }

std::vector<TruthScene> quick_scenes() {
  std::vector<TruthScene> quick;
  for (const TruthScene& scene : shadow_scenes()) {
    for (const std::string_view name : {"camera_in_shadow", "light_in_open_box", "lamp_and_sun"}) {
      if (scene.name == name) quick.push_back(scene);
    }
  }
  return quick;
}
INSTANTIATE_TEST_SUITE_P(Shadows, IndirectModels, testing::ValuesIn(quick_scenes()),
                         [](const auto& test) { return std::string(test.param.name); });

// The table of docs/RESULTS.md, up to some minutes a scene: no test of every day.
class IndirectTable : public testing::TestWithParam<TruthScene> {};
TEST_P(IndirectTable, DISABLED_UnboundedBesideExact) { compare_models(GetParam(), {12, 9}, 1e-1); }
INSTANTIATE_TEST_SUITE_P(Shadows, IndirectTable, testing::ValuesIn(shadow_scenes().begin(), shadow_scenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace airlight
