// Tabulated reflectances: tables beside what they are tables of, techniques beside the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "app/airlight.h"
#include "common/reference/reference.h"
#include "common/scene/brdf.h"
#include "common/scene/brdf_file.h"
#include "tests/formulas/checks/random.h"
#include "tests/parity/brdfs.h"
#include "tests/tolerances.h"
#include "tests/truth/relative_error.h"
#include "tests/truth/scenes.h"

namespace airlight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr ReferenceParts surfaces_alone{true, false};

// Relative RMS over ways to the light and the viewer that are at least `horizon` radians above the horizon, by chance.
double table_error(const Brdf& brdf, double roughness, double horizon) {
  Random random(400);
  const glm::dvec3 n = random.direction();
  double wrong = 0, all = 0;
  for (int i = 0; i < 20000; ++i) {
    glm::dvec3 l = random.direction(), v = random.direction();
    if (glm::dot(n, l) < 0) l = -l;
    if (glm::dot(n, v) < 0) v = -v;
    const double light = glm::dot(n, l), viewer = glm::dot(n, v);
    if (std::min(light, viewer) < std::sin(horizon)) continue;
    const glm::dvec3 h = glm::normalize(l + v);
    const glm::dvec3 truth = light * microfacets(roughness, glm::dot(n, h), glm::dot(l, h), light, viewer);
    const glm::dvec3 error = tabulated_reflection(brdf, n, l, v) - truth;
    wrong += glm::dot(error, error), all += glm::dot(truth, truth);
  }
  return std::sqrt(wrong / all);
}

TEST(Tables, ApproachWhatTheyAreTablesOf) {
  double before = 1;
  for (const int parts : {1, 2, 4}) {
    const glm::ivec3 size = glm::ivec3(20, 12, 16) * parts;
    const double everywhere = table_error(*microfacet_table(size, 0.3), 0.3, 0),
                 above = table_error(*microfacet_table(size, 0.3), 0.3, 0.1);
    std::printf("%d x %d x %d cells: relative RMS %.3f %%, of ways 6 degrees above the horizon %.3f %%\n", size.x, size.y, size.z,
                100 * everywhere, 100 * above);
    EXPECT_LT(above, before / 2.5);  // of second order
    before = above;
  }
  EXPECT_FALSE(!(before <= tolerance("brdf_table")));
}

// The file is made by a script of its own (scenes/make_brdf.py), and has no values below the horizon.
TEST(Tables, ShippedGoldIsGold) {
  const BrdfFile gold = read_brdf_file(AIRLIGHT_SCENES "/gold.binary");
  const double everywhere = table_error(*gold.brdf, 0.3, 0), above = table_error(*gold.brdf, 0.3, 0.1);
  std::printf("relative RMS %.3f %%, of ways 6 degrees above the horizon %.3f %%\n", 100 * everywhere, 100 * above);
  const Material& m = gold.material;
  std::printf("diffuse %.4f %.4f %.4f, specular %.4f %.4f %.4f, shininess %.2f\n", static_cast<double>(m.diffuse.x),
              static_cast<double>(m.diffuse.y), static_cast<double>(m.diffuse.z), static_cast<double>(m.specular.x),
              static_cast<double>(m.specular.y), static_cast<double>(m.specular.z), static_cast<double>(m.shininess));
  EXPECT_FALSE(!(above <= tolerance("brdf_shipped")));
  EXPECT_FALSE(!(everywhere <= tolerance("brdf_horizon")));
}

TEST(Tables, LightAndViewerMayBeExchanged) {
  const std::shared_ptr<const Brdf> brdf = microfacet_table({9, 7, 6}, 0.4, 0.6);
  Random random(401);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 n = random.direction(), l = random.direction(), v = random.direction();
    if (glm::dot(n, l) < 0.01 || glm::dot(n, v) < 0.01) continue;
    const glm::dvec3 there = tabulated_reflection(*brdf, n, l, v) / glm::dot(n, l),
                     back = tabulated_reflection(*brdf, n, v, l) / glm::dot(n, v);
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::fabs(there[c] / back[c] - 1));
  }
  std::printf("relative difference %.2g\n", worst);
  EXPECT_LE(worst, 1e-9);
}

Environment sky(double sharpness) {
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
  return {image, {1, 1, 1}, 20};
}

// A box on a floor, both of that reflectance, in fog.
Scene box_of(const std::shared_ptr<const Brdf>& brdf) {
  Scene scene;
  scene.camera.position = {2.2, 1.8, 3.4}, scene.camera.look_at = {0, 0.5, 0};
  scene.medium.extinction = 0.08;
  scene.sky_distance = 20;
  Mesh floor;
  add_parallelogram(floor, {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
  scene.surfaces = {surface(std::move(floor), diffuse(0, 0, 0), true),
                    surface(box({-0.6, 0, -0.6}, {0.6, 1.1, 0.6}), diffuse(0, 0, 0), true)};
  for (Surface& s : scene.surfaces) s.brdf = brdf, s.material = brdf_material(*brdf);
  return scene;
}

// The truth where surfaces are seen, off their edges.
struct SurfaceTruth {
  static constexpr Extent extent{20, 15};
  std::vector<ReferencePixel> pixels;
  std::vector<bool> counts;

  explicit SurfaceTruth(const Scene& scene) {
    const Reference reference(scene, {.indirect = Indirect::unbounded});
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < extent.width; ++x) {
        const glm::dvec2 at(x + 0.5, y + 0.5);
        pixels.push_back(reference.pixel(at, extent, surfaces_alone));
        counts.push_back(pixels.back().surface_index >= 0 && !reference.edge(at, extent));
      }
    }
  }
  RelativeRmse error(const HostImage& image, glm::dvec3 ReferencePixel::*part) const {
    RelativeRmse e;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      for (std::size_t c = 0; c < 3 && counts[i]; ++c)
        e.add(static_cast<double>(image.values[3 * i + c]), (pixels[i].*part)[static_cast<int>(c)]);
    }
    return e;
  }
};

Frame rendered(const Scene& scene, const char* backend, std::string_view technique, const std::set<std::string>& images) {
  Renderer renderer({.backend = backend});
  RenderSettings settings;
  settings.technique = technique;
  settings.resolution = SurfaceTruth::extent;
  settings.images.assign(images.begin(), images.end());
  return renderer.render(scene, settings);
}

TEST(TabulatedSurfaces, ReflectLightsAsTheReferenceSays) {
  Scene scene = box_of(microfacet_table({40, 24, 32}, 0.3, 0.4));
  scene.medium.ambient = {0.01, 0.02, 0.03};
  scene.lights = {point_light({1.2, 2, 1.4}, {6, 5, 4}), directional_light({0.4, -1, 0.7}, {0.5, 0.6, 0.7})};
  const SurfaceTruth truth(scene);
  for (const char* backend : {"cpu", "gl"}) {
    for (const char* technique : {"shadow-planes", "gaussian-airlight"}) {
      const Frame frame = rendered(scene, backend, technique, {"surface", "surface.direct"});
      const RelativeRmse direct = truth.error(frame.image("surface.direct"), &ReferencePixel::surface_direct),
                         all = truth.error(frame.image("surface"), &ReferencePixel::surface);
      std::printf("%s %s: relative RMSE of direct light %.5f %%, of all %.5f %%\n", backend, technique, 100 * direct.value(),
                  100 * all.value());
      EXPECT_GT(direct.mean_truth(), 0.01);
      EXPECT_FALSE(!(direct.value() <= tolerance("brdf_direct")));
      EXPECT_FALSE(!(all.value() <= tolerance("truth_off_edges")));
    }
  }
}

struct Sky {
  std::string name, bound;
  double roughness, sharpness;
};
void PrintTo(const Sky& s, std::ostream* out) { *out << s.name; }

class TabulatedUnderSkies : public testing::TestWithParam<Sky> {};

TEST_P(TabulatedUnderSkies, StatesTheDistance) {
  const Sky& p = GetParam();
  Scene scene = box_of(microfacet_table({40, 24, 32}, p.roughness));
  scene.environment = sky(p.sharpness);
  for (Surface& s : scene.surfaces) s.casts_shadow = false;  // what is hidden is left out
  const SurfaceTruth truth(scene);
  for (const char* backend : {"cpu", "gl"}) {
    const Frame frame = rendered(scene, backend, "gaussian-airlight", {"surface.environment"});
    const RelativeRmse error = truth.error(frame.image("surface.environment"), &ReferencePixel::surface_environment);
    std::printf("%s: relative RMSE on surfaces %.3f %%\n", backend, 100 * error.value());
    EXPECT_GT(error.mean_truth(), 0.01);
    EXPECT_FALSE(!(error.value() <= tolerance(p.bound)));
  }
}

INSTANTIATE_TEST_SUITE_P(Skies, TabulatedUnderSkies,
                         testing::Values(Sky{"soft_sky_rough", "brdf_soft_rough", 0.6, 4},
                                         Sky{"soft_sky_glossy", "brdf_soft_glossy", 0.3, 4},
                                         Sky{"sharp_sky_rough", "brdf_sharp_rough", 0.6, 40},
                                         Sky{"sharp_sky_glossy", "brdf_sharp_glossy", 0.3, 40}),
                         [](const auto& test) { return test.param.name; });

// The same everywhere, it is Lambert's: as bright as the material, under lamps, the sky, and in light that scatters on its way.
TEST(TabulatedSurfaces, OfOneValueAreMatt) {
  const glm::vec3 albedo(0.6F, 0.4F, 0.2F);
  Scene scene = box_of(constant_table(albedo / static_cast<float>(pi)));
  const glm::dvec3 found = brdf_albedo(*scene.surfaces[0].brdf);
  std::printf("albedo %.5f %.5f %.5f\n", found.x, found.y, found.z);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], static_cast<double>(albedo[c]), 1e-3);
  scene.environment = sky(4);
  for (Surface& s : scene.surfaces) s.casts_shadow = false;
  scene.lights = {point_light({1.2, 2, 1.4}, {6, 5, 4})};
  Scene matt = scene;
  for (Surface& s : matt.surfaces) s.brdf = nullptr, s.material.diffuse = albedo;
  Renderer renderer(RendererOptions{});
  RenderSettings settings;
  settings.resolution = Extent{24, 18};
  settings.images = {"surface.direct", "surface.environment", "surface.indirect"};
  const Frame table = renderer.render(scene, settings), material = renderer.render(matt, settings);
  for (const std::string& name : settings.images) {
    RelativeRmse error;
    for (std::size_t i = 0; i < table.image(name).values.size(); ++i)
      error.add(static_cast<double>(table.image(name).values[i]), static_cast<double>(material.image(name).values[i]));
    std::printf("%s: relative RMS difference %.2g\n", name.c_str(), error.value());
    EXPECT_GT(error.mean_truth(), 1e-3);
    EXPECT_FALSE(!(error.value() <= tolerance("brdf_matt")));
  }
}

// Light that scatters on its way is reflected as by the lobes nearest to the table, and, for comparison, evenly by the albedo:
// how far that is from the table itself, on an open floor, looked at from above and along it.
TEST(TabulatedSurfaces, ReflectScatteredLightByTheNearestLobes) {
  Scene scene = box_of(microfacet_table({40, 24, 32}, 0.3));
  scene.surfaces.pop_back();
  scene.medium.extinction = 0.2;
  Scene matt = scene;
  Material& m = scene.surfaces[0].material;
  std::printf("diffuse %.3f, specular %.3f, shininess %.1f\n", static_cast<double>(m.diffuse.y),
              static_cast<double>(m.specular.y), static_cast<double>(m.shininess));
  matt.surfaces[0].material = {.diffuse = m.diffuse + m.specular};
  RelativeRmse nearest, evenly;
  for (const double height : {3.0, 0.7}) {
    for (const LightSource& light : {point_light({0.9, 1.7, -0.5}, {10, 9, 8}), directional_light({0.3, -1, 0.2}, {1, 2, 3})}) {
      const auto pixel = [&](Scene& s, Indirect indirect) {
        s.camera.position = {2, height, 0.3}, s.camera.look_at = {0, 0, 0}, s.lights = {light};
        return Reference(s, {.indirect = indirect, .indirect_tolerance = 0.03}).pixel(centre, one_pixel, surfaces_alone);
      };
      const ReferencePixel exact = pixel(scene, Indirect::exact), lobes = pixel(scene, Indirect::unbounded),
                           even = pixel(matt, Indirect::unbounded);
      for (int c = 0; c < 3; ++c) {
        nearest.add(lobes.surface_indirect[c], exact.surface_indirect[c]);
        evenly.add(even.surface_indirect[c], exact.surface_indirect[c]);
        EXPECT_GT(exact.surface_indirect[c], 0);
      }
      std::printf("%s, viewer %.0f degrees high: %.3f of the exact light, evenly %.3f, which is %.3f of it all\n",
                  light.type == LightType::point ? "lamp" : "sun", std::atan2(height, 2.02) * 180 / pi,
                  lobes.surface_indirect.y / exact.surface_indirect.y, even.surface_indirect.y / exact.surface_indirect.y,
                  exact.surface_indirect.y / exact.surface.y);
    }
  }
  std::printf("relative RMSE of scattered light %.1f %%, evenly %.1f %%\n", 100 * nearest.value(), 100 * evenly.value());
  EXPECT_FALSE(!(nearest.value() <= tolerance("brdf_scattered")));
}

}  // namespace
}  // namespace airlight
