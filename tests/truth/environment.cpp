// The light of environments against the reference, and the reference against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>

#include "app/airlight.h"
#include "common/reference/reference.h"
#include "tests/parity/inputs.h"
#include "tests/tolerances.h"
#include "tests/truth/relative_error.h"
#include "tests/truth/scenes.h"

namespace airlight {
namespace {

constexpr double pi = std::numbers::pi;

// A sky that is bright about one direction, over dim ground.
Environment sky(double sharpness, double rotation) {
  constexpr Extent extent{32, 16};
  auto image = std::make_shared<HostImage>(extent, 3);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const double azimuth = 2 * pi * ((x + 0.5) / extent.width - 0.5), polar = pi * (y + 0.5) / extent.height;
      const double toward_sun = std::cos(polar) * 0.6 + std::sin(polar) * 0.8 * std::cos(azimuth - 0.6);
      const double glow = 4 * std::exp(sharpness * (toward_sun - 1)), up = 0.3 + 0.2 * std::cos(polar);
      for (int c = 0; c < 3; ++c) image->at(x, y, c) = static_cast<float>(up * (1 + 0.4 * c) + glow * (1 - 0.2 * c));
    }
  }
  return {image, {1, 1, 1}, rotation};
}

// A box on a floor under the sky, partly matt and partly glossy.
Scene box_under(const Environment& environment, float specular, float shininess) {
  Scene scene;
  scene.environment = environment;
  scene.camera.position = {2.2, 1.8, 3.4}, scene.camera.look_at = {0, 0.5, 0};
  Mesh floor;
  add_parallelogram(floor, {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
  Material glossy = diffuse(0.5F, 0.4F, 0.3F), matt = diffuse(0.7F, 0.7F, 0.7F);
  glossy.specular = glm::vec3(specular), glossy.shininess = shininess;
  scene.surfaces = {surface(std::move(floor), glossy, false),
                    surface(box({-0.6, 0, -0.6}, {0.6, 1.1, 0.6}), specular > 0 ? glossy : matt, false)};
  return scene;
}

Scene in_steam(Scene scene, double thickness) {
  scene.medium.gaussians = {{.center = {0.2, 0.9, 0.4}, .radius = 0.7, .extinction = 0.9 * thickness},
                            {.center = {-1, 0.5, 1}, .radius = 0.5, .extinction = 1.5 * thickness},
                            {.center = {1.4, 0.7, -1}, .radius = 0.8, .extinction = 0.5 * thickness}};
  return scene;
}

struct Case {
  std::string_view name, bound;
  Scene (*make)();
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

Scene in_fog(Scene scene) {
  scene.medium.extinction = 0.08;
  scene.sky_distance = 20;
  return scene;
}

constexpr Case cases[] = {
    {"soft_sky_matt", "environment_soft_matt", [] { return in_fog(box_under(sky(4, 20), 0, 20)); }},
    {"soft_sky_glossy", "environment_soft_glossy", [] { return in_fog(box_under(sky(4, 20), 0.3F, 10)); }},
    {"sharp_sky_matt", "environment_sharp_matt", [] { return in_fog(box_under(sky(40, -75), 0, 20)); }},
    {"sharp_sky_glossy", "environment_sharp_glossy", [] { return in_fog(box_under(sky(40, -75), 0.3F, 40)); }},
    {"thin_steam_matt", "environment_thin_steam", [] { return in_steam(box_under(sky(4, 20), 0, 20), 0.3); }},
    {"thick_steam_matt", "environment_thick_steam", [] { return in_steam(box_under(sky(4, 20), 0, 20), 1); }},
};

// The truth without airlight, which takes long.
ReferenceFrame surfaces_alone(const Scene& scene, Extent extent) {
  const Reference reference(scene);
  ReferenceFrame frame;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const glm::dvec2 at(x + 0.5, y + 0.5);
      frame.pixels.push_back(reference.pixel(at, extent, {true, false}));
      frame.edges.push_back(reference.edge(at, extent));
      frame.error = std::max(frame.error, frame.pixels.back().error);
    }
  }
  return frame;
}

class EnvironmentTruth : public testing::TestWithParam<Case> {};

TEST_P(EnvironmentTruth, StatesTheDistance) {
  const Scene scene = GetParam().make();
  constexpr Extent extent{32, 24};
  const ReferenceFrame truth = surfaces_alone(scene, extent);
  std::printf("truth claims %.1e\n", truth.error);
  EXPECT_FALSE(!(truth.error <= tolerance("environment_truth")));
  for (const char* backend : {"cpu", "gl"}) {
    Renderer renderer({.backend = backend});
    for (const std::string_view technique : {"shadow-planes", "gaussian-airlight", "marching", "opacity-propagation"}) {
      if (technique == "shadow-planes" && !scene.medium.gaussians.empty()) continue;
      if (technique != "gaussian-airlight" && backend == std::string_view("gl")) continue;
      RenderSettings settings;
      settings.technique = technique;
      settings.resolution = extent;
      settings.images = {"surface", "surface.environment"};
      const Frame frame = renderer.render(scene, settings);
      RelativeRmse reflected, seen;
      const HostImage &all = frame.image("surface"), &part = frame.image("surface.environment");
      for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const ReferencePixel& p = truth.pixels[i];
        for (int c = 0; c < 3 && !truth.edges[i]; ++c) {
          const std::size_t k = 3 * i + static_cast<std::size_t>(c);
          EXPECT_EQ(all.values[k], part.values[k]);  // there is no other light
          (p.surface_index < 0 ? seen : reflected).add(static_cast<double>(part.values[k]), p.surface_environment[c]);
        }
      }
      std::printf("%s %s: relative RMSE on surfaces %.3f %%, of what is seen behind them %.5f %%\n", backend,
                  std::string(technique).c_str(), 100 * reflected.value(), 100 * seen.value());
      EXPECT_GT(reflected.mean_truth(), 0.01);
      EXPECT_GT(seen.mean_truth(), 0.01);
      EXPECT_FALSE(!(reflected.value() <= tolerance(GetParam().bound)));
      EXPECT_FALSE(!(seen.value() <= tolerance("environment_seen")));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Skies, EnvironmentTruth, testing::ValuesIn(cases),
                         [](const auto& test) { return std::string(test.param.name); });

// Steam of many Gaussians about the box: where their mean depths are found, beside the truth and beside a depth a pixel.
TEST(EnvironmentDepth, StatesTheDistance) {
  Scene scene = box_under(sky(4, 20), 0, 20);
  for (std::uint32_t i = 0; i < 60; ++i) {
    const auto number = [&](std::uint32_t k) { return uniform(185, 4 * i + k); };
    scene.medium.gaussians.push_back({.center = {3 * number(0) - 1.5, 1.8 * number(1), 3 * number(2) - 1.5},
                                      .radius = 0.25 + 0.2 * number(3),
                                      .extinction = 0.25});
  }
  constexpr Extent extent{16, 12};
  const ReferenceFrame truth = surfaces_alone(scene, extent);
  EXPECT_FALSE(!(truth.error <= tolerance("environment_truth")));
  for (const char* backend : {"cpu", "gl"}) {
    Renderer renderer({.backend = backend, .gl_context = "osmesa"});
    HostImage of_pixels;
    double error_of_pixels = 0;
    for (const char* choice : {"pixel", "lattice", "object"}) {
      RenderSettings settings;
      settings.technique = "gaussian-airlight";
      settings.knobs = {{"environment_depth", choice}};
      settings.resolution = extent;
      settings.images = {"surface"};
      const Frame frame = renderer.render(scene, settings);
      const HostImage& image = frame.image("surface");
      if (of_pixels.values.empty()) of_pixels = image;
      RelativeRmse error, beside;
      for (std::size_t i = 0; i < image.values.size(); ++i) {
        if (truth.edges[i / 3] || truth.pixels[i / 3].surface_index < 0) continue;
        error.add(static_cast<double>(image.values[i]), truth.pixels[i / 3].surface_environment[static_cast<int>(i % 3)]);
        beside.add(static_cast<double>(image.values[i]), static_cast<double>(of_pixels.values[i]));
      }
      std::printf("%s %s: relative RMSE on surfaces %.2f %%, to a depth a pixel %.3f %%\n", backend, choice, 100 * error.value(),
                  100 * beside.value());
      if (choice == std::string_view("pixel")) {
        error_of_pixels = error.value();
        EXPECT_FALSE(!(error.value() <= tolerance("environment_depth_pixel")));
      } else if (choice == std::string_view("lattice")) {
        EXPECT_GT(beside.value(), 0);
        EXPECT_FALSE(!(beside.value() <= tolerance("environment_depth_lattice")));
        EXPECT_FALSE(!(error.value() <= error_of_pixels + tolerance("environment_depth_lattice")));
      } else {
        EXPECT_FALSE(!(error.value() <= tolerance("environment_depth_object")));
      }
    }
  }
}

Scene steam(double thickness) {
  Scene scene = in_steam(box_under(sky(4, 20), 0, 20), thickness);
  scene.surfaces.clear();
  return scene;
}

Scene fog(const Phase& phase) {
  Scene scene;
  scene.environment = sky(8, 20);
  scene.medium.extinction = 0.1, scene.medium.phase = phase, scene.medium.albedo = {0.9, 0.8, 0.7};
  scene.sky_distance = 15;
  scene.camera.vertical_fov = 90, scene.camera.look_at = {0.5, 0.3, -1};
  return scene;
}

constexpr Case airlight_cases[] = {
    {"thin_steam", "environment_airlight_thin", [] { return steam(0.3); }},
    {"steam", "environment_airlight_steam", [] { return steam(1); }},
    {"thick_steam", "environment_airlight_thick", [] { return steam(4); }},
    {"steam_before_a_box", "environment_airlight_steam", [] { return in_steam(box_under(sky(4, 20), 0, 20), 1); }},
    {"fog", "environment_airlight_fog", [] { return fog({}); }},
    {"forward_fog", "environment_airlight_fog",
     [] {
       return fog({PhaseKind::henyey_greenstein, 0.6});
     }},
    {"steam_in_fog", "environment_airlight_steam",
     [] {
       Scene scene = in_fog(steam(1));
       scene.medium.phase = {PhaseKind::henyey_greenstein, 0.5};
       scene.medium.gaussians[0].albedo = {1, 0.6, 0.4};
       return scene;
     }},
};

class EnvironmentAirlightTruth : public testing::TestWithParam<Case> {};

TEST_P(EnvironmentAirlightTruth, StatesTheDistance) {
  const Scene scene = GetParam().make();
  constexpr Extent extent{7, 5};
  NoProgress progress;
  ReferenceSettings precision;
  precision.tolerance = 1e-3;
  const ReferenceFrame truth = reference_frame(scene, extent, precision, false, 2, progress);
  std::printf("truth claims %.1e\n", truth.error);
  EXPECT_FALSE(!(truth.error <= tolerance("environment_truth")));
  for (const char* backend : {"cpu", "gl"}) {
    Renderer renderer({.backend = backend});
    for (const std::string_view choice : {"on", "published", "off"}) {
      if (choice == "published" && scene.medium.phase.kind != PhaseKind::isotropic) continue;
      RenderSettings settings;
      settings.technique = "gaussian-airlight";
      settings.knobs = {{"environment_airlight", std::string(choice)}};
      settings.resolution = extent;
      settings.images = {"airlight"};
      const Frame frame = renderer.render(scene, settings);
      RelativeRmse error;
      for (std::size_t i = 0; i < 3 * truth.pixels.size(); ++i)
        error.add(static_cast<double>(frame.image("airlight").values[i]), truth.pixels[i / 3].airlight[static_cast<int>(i % 3)]);
      std::printf("%s %s: relative RMSE of the airlight %.2f %%\n", backend, std::string(choice).c_str(), 100 * error.value());
      if (choice == "off") {
        EXPECT_GT(error.value(), 0.9);  // nothing else is airlight
      } else {
        EXPECT_FALSE(!(error.value() <= tolerance(choice == "on" ? GetParam().bound : "environment_airlight_published")));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Skies, EnvironmentAirlightTruth, testing::ValuesIn(airlight_cases),
                         [](const auto& test) { return std::string(test.param.name); });

// From everywhere the same: a matt surface sends its diffuse reflectance of it, a glossy one more by its specular one where its
// lobe is above the horizon; in the middle of a Gaussian less by its optical depth from there, the same in all directions.
TEST(EnvironmentReference, OfOneRadianceHasClosedForms) {
  Scene scene;
  scene.environment = Environment{nullptr, {1, 2, 3}, 0};
  scene.camera.position = {0, 2, 0}, scene.camera.look_at = {0, 0, 0}, scene.camera.up = {0, 0, -1};
  Mesh floor;
  add_parallelogram(floor, {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
  for (const double extinction : {0.0, 1.3}) {
    for (const float shininess : {1.0F, 30.0F, 2000.0F}) {
      Material material = diffuse(0.5F, 0.4F, 0.3F);
      material.specular = {0.1F, 0.2F, 0.3F}, material.shininess = shininess;
      scene.surfaces = {surface(floor, material, true)};
      scene.medium.gaussians = {{.center = {0, 0, 0}, .radius = 0.2, .extinction = extinction}};
      const double through = std::exp(-extinction * 0.2 * std::sqrt(pi) / 2);
      const ReferencePixel pixel = Reference(scene).pixel(centre, one_pixel, {true, false});
      for (int c = 0; c < 3; ++c) {
        const double expected = through * pixel.transmittance * scene.environment->radiance[c] *
                                static_cast<double>(material.diffuse[c] + material.specular[c]);
        std::printf("shininess %g: %.7f of %.7f\n", static_cast<double>(shininess), pixel.surface_environment[c], expected);
        EXPECT_FALSE(!(std::fabs(pixel.surface_environment[c] / expected - 1) <= tolerance("environment_closed_form")));
        EXPECT_LE(std::fabs(pixel.surface_environment[c] / expected - 1), pixel.error);
      }
    }
  }
}

}  // namespace
}  // namespace airlight
