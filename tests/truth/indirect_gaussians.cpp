// Light of lamps that Gaussians scatter once onto surfaces: the models of the knob `indirect` against what they are by
// definition, and against what there is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "app/airlight.h"
#include "common/plan/zonal.h"
#include "common/reference/indirect.h"
#include "common/reference/optical_depth.h"
#include "common/reference/reference.h"
#include "common/relative_rmse.h"
#include "tests/tolerances.h"
#include "tests/truth/scenes.h"

namespace airlight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::string_view models[] = {"mean_density", "psf"};

// A floor seen from above under a lamp 3 m over its middle.
Scene lamp_over_floor(double fog, std::vector<Gaussian> gaussians, glm::vec3 specular = glm::vec3(0)) {
  Scene scene = foggy_scene(fog);
  scene.camera = {.position = {0.3, 6, 3.5}, .look_at = {0, 0, 0}, .vertical_fov = 35};
  scene.lights = {point_light({0, 3, 0}, {10, 9, 8})};
  scene.medium.gaussians = std::move(gaussians);
  Mesh mesh;
  add_parallelogram(mesh, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  Material material = diffuse(0.5F, 0.4F, 0.3F);
  material.specular = specular, material.shininess = 20;
  scene.surfaces = {surface(std::move(mesh), material, false)};
  return scene;
}

Gaussian blob(glm::dvec3 center, double radius, double extinction) {
  return {.center = center, .radius = radius, .extinction = extinction};
}

std::vector<Gaussian> ring_of_eight(double extinction) {
  std::vector<Gaussian> all;
  for (int i = 0; i < 8; ++i)
    all.push_back(blob({1.3 * std::cos(i * pi / 4), 0.6 + 0.25 * (i % 4), 1.3 * std::sin(i * pi / 4)}, 0.5, extinction));
  return all;
}

std::vector<Gaussian> lattice_of_27(double extinction) {
  std::vector<Gaussian> all;
  for (int i = 0; i < 27; ++i) all.push_back(blob({1.1 * (i % 3 - 1), 0.6 + i / 9, 1.1 * (i / 3 % 3 - 1)}, 0.7, extinction));
  return all;
}

HostImage indirect_of(const Scene& scene, const char* backend, std::string_view model, Extent extent) {
  Renderer renderer({.backend = backend});
  RenderSettings settings;
  settings.technique = "gaussian-airlight";
  settings.resolution = extent;
  settings.knobs = {{"indirect", std::string(model)}, {"lost_depth", "1e-5"}};
  settings.images = {"surface.indirect"};
  return renderer.render(scene, settings).image("surface.indirect");
}

// Of one light, relative to the camera, by quadrature and sums in double that share nothing with the techniques' tables.
glm::dvec3 by_definition(const Scene& scene, const LightSource& source, const ReferencePixel& pixel, const glm::dvec3& d,
                         std::string_view model) {
  const Medium& medium = scene.medium;
  const Material& material = scene.surfaces[0].material;
  const bool sun = source.type == LightType::directional;
  const glm::dvec3 at = scene.camera.position + pixel.depth * d, mirror = d - 2 * glm::dot(d, pixel.normal) * pixel.normal;
  const double length = sun ? 1 : glm::distance(source.position, at);
  const glm::dvec3 toward = sun ? -source.direction : (source.position - at) / length;
  const double rest = optical_depth(medium.gaussians, at, toward, sun ? 1e30 : length);
  const double fog = sun ? 0 : medium.extinction * length, lambda = fog + rest;
  glm::dvec3 albedo(0);
  double mass = 0;
  for (const Gaussian& g : medium.gaussians) {
    const double one = g.extinction * g.radius * g.radius * g.radius;
    albedo += one * g.albedo, mass += one;
  }
  const glm::dvec3 mixed = (fog * medium.albedo + rest * albedo / mass) / lambda;
  const auto lobe = [&](const glm::dvec3& axis, double n) {
    const double cosine = std::clamp(glm::dot(axis, toward), -1.0, 1.0), norm = (n + 1) / (2 * pi),
                 fall_off = 1 / (length * length);
    if (model == "psf") {
      const Zonal npsf = npsf_coefficients();
      double sum = 0;
      for (unsigned l = 0; l < 6; ++l) {
        double moment = 0;  // of the lobe
        for (int i = 0; i < 2000; ++i)
          moment += (n + 1) * std::pow((i + 0.5) / 2000, n) * std::legendre(l, (i + 0.5) / 2000) / 2000;
        sum += npsf[l] * std::sqrt((2 * l + 1) / (4 * pi)) * moment * std::legendre(l, cosine);
      }
      return fall_off * lambda * std::exp(-lambda) * std::max(sum, 0.0) * mixed;
    }
    glm::dvec3 value = fall_off * norm * indirect_lobe(medium.phase, false, lambda, std::acos(cosine), n) * mixed;
    if (sun && medium.extinction > 0)
      value += norm * indirect_lobe(medium.phase, true, 0, std::acos(cosine), n) * std::exp(-rest) * medium.albedo;
    return value;
  };
  return pixel.transmittance * source.power *
         (glm::dvec3(material.diffuse) * lobe(pixel.normal, 1) +
          glm::dvec3(material.specular) * lobe(mirror, static_cast<double>(material.shininess)));
}

glm::dvec3 direction(const Camera& camera, double x, double y, Extent extent) {
  const glm::dvec3 forward = glm::normalize(camera.look_at - camera.position);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const double tan = std::tan(camera.vertical_fov / 360 * pi);
  return glm::normalize(forward + (2 * x / extent.width - 1) * tan * extent.width / extent.height * right +
                        (1 - 2 * y / extent.height) * tan * up);
}

TEST(IndirectOfGaussians, IsWhatTheModelsAreByDefinition) {
  constexpr Extent extent{3, 2};
  for (const bool fog : {false, true}) {
    Scene scene = lamp_over_floor(fog ? 0.1 : 0, ring_of_eight(0.8), glm::vec3(0.3F));
    scene.medium.albedo = {0.9, 0.8, 0.7};
    scene.medium.gaussians[0].albedo = {0.2, 0.5, 1};
    scene.lights.push_back(directional_light({0.4, -1, 0.2}, {0.5, 0.6, 0.7}));
    const Reference reference(scene);
    for (const std::string_view model : models) {
      HostImage truth(extent, 3);
      double top = 0;
      for (int y = 0; y < extent.height; ++y) {
        for (int x = 0; x < extent.width; ++x) {
          const ReferencePixel pixel = reference.pixel({x + 0.5, y + 0.5}, extent, {true, false});
          const glm::dvec3 d = direction(scene.camera, x + 0.5, y + 0.5, extent);
          glm::dvec3 sum(0);
          for (const LightSource& light : scene.lights) sum += by_definition(scene, light, pixel, d, model);
          for (int c = 0; c < 3; ++c) truth.at(x, y, c) = static_cast<float>(sum[c]), top = std::max(top, sum[c]);
        }
      }
      EXPECT_GT(top, 0.01);
      for (const char* backend : {"cpu", "gl"}) {
        if (!fog && backend == std::string_view("gl")) continue;
        const HostImage image = indirect_of(scene, backend, model, extent);
        double worst = 0;
        for (std::size_t i = 0; i < truth.values.size(); ++i)
          worst = std::max(worst, static_cast<double>(std::fabs(image.values[i] - truth.values[i])));
        std::printf("%s, %s: at most %.2g of the brightest away\n", std::string(model).c_str(), backend, worst / top);
        EXPECT_FALSE(!(worst / top <= tolerance("indirect_of_gaussians")));
      }
    }
  }
}

// Where neither Gaussians nor a grid are, nothing changes.
TEST(IndirectOfGaussians, MeanDensityOfFogIsUnbounded) {
  const Scene scene = lamp_over_floor(0.2, {}, glm::vec3(0.3F));
  EXPECT_EQ(indirect_of(scene, "cpu", "mean_density", {6, 4}).values, indirect_of(scene, "cpu", "unbounded", {6, 4}).values);
}

struct Place {
  std::string_view name;
  Scene (*make)();
  double mean_density, psf;  // relative RMSE at most
};
void PrintTo(const Place& p, std::ostream* out) { *out << p.name; }

// How far the models are from what there is; 1 is to leave it out.
void compare(const Place& place, Extent extent, double exact_to, bool hold) {
  const Scene scene = place.make();
  ReferenceSettings settings;
  settings.indirect = Indirect::exact, settings.indirect_tolerance = exact_to;
  const Reference reference(scene, settings);
  std::vector<ReferencePixel> truth;
  double indirect = 0, direct = 0;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      truth.push_back(reference.pixel({x + 0.5, y + 0.5}, extent, {true, false}));
      indirect += truth.back().surface_indirect.y, direct += truth.back().surface_direct.y;
    }
  }
  std::printf("%s: %.1f %% of the direct light;", std::string(place.name).c_str(), 100 * indirect / direct);
  for (const std::string_view model : {"unbounded", "mean_density", "psf"}) {
    if (model == "unbounded" && !(scene.medium.extinction > 0)) continue;
    const HostImage image = indirect_of(scene, "cpu", model, extent);
    RelativeRmse error, of_surface;
    double sum = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        const auto value = static_cast<double>(image.values[3 * i + static_cast<std::size_t>(c)]);
        const double rest = truth[i].surface[c] - truth[i].surface_indirect[c];
        error.add(value, truth[i].surface_indirect[c]);
        of_surface.add(value + rest, truth[i].surface[c]);
        if (c == 1) sum += value;
      }
    }
    std::printf(" %s %.2f of it, relative RMSE %.0f %%, of surfaces %.1f %%;", std::string(model).c_str(), sum / indirect,
                100 * error.value(), 100 * of_surface.value());
    if (!hold) continue;
    if (model == "unbounded") continue;
    EXPECT_FALSE(!(error.value() <= (model == "psf" ? place.psf : place.mean_density)));
  }
  RelativeRmse without;
  for (const ReferencePixel& p : truth) {
    for (int c = 0; c < 3; ++c) without.add(p.surface[c] - p.surface_indirect[c], p.surface[c]);
  }
  std::printf(" surfaces without it %.1f %%\n", 100 * without.value());
}

constexpr Place places[] = {
    {"fog", [] { return lamp_over_floor(0.5, {}); }, 0.01, 0.3},
    {"cloud_about_the_lamp",
     [] {
       return lamp_over_floor(0, {blob({0, 3, 0}, 0.7, 0.4)});
     },
     0.25, 0.25},
    {"wide_cloud",
     [] {
       return lamp_over_floor(0, {blob({0, 1.5, 0}, 4, 0.5)});
     },
     0.1, 0.3},
};
class IndirectPlaces : public testing::TestWithParam<Place> {};
TEST_P(IndirectPlaces, ModelsBesideExact) { compare(GetParam(), {2, 1}, 5e-2, true); }
INSTANTIATE_TEST_SUITE_P(Gaussians, IndirectPlaces, testing::ValuesIn(places),
                         [](const auto& test) { return std::string(test.param.name); });

// The table of docs/RESULTS.md, minutes: no test of every day.
constexpr Place table[] = {
    {"fog_of_0.1", [] { return lamp_over_floor(0.1, {}); }, 0, 0},
    {"fog_of_0.5", [] { return lamp_over_floor(0.5, {}); }, 0, 0},
    {"thin_blob_between",
     [] {
       return lamp_over_floor(0, {blob({0, 1.5, 0}, 0.5, 0.4)});
     },
     0, 0},
    {"dense_blob_between",
     [] {
       return lamp_over_floor(0, {blob({0, 1.5, 0}, 0.5, 4)});
     },
     0, 0},
    {"thin_wide_blob_between",
     [] {
       return lamp_over_floor(0, {blob({0, 1.5, 0}, 1.2, 0.2)});
     },
     0, 0},
    {"dense_wide_blob_between",
     [] {
       return lamp_over_floor(0, {blob({0, 1.5, 0}, 1.2, 1.5)});
     },
     0, 0},
    {"thin_cloud_about_the_lamp",
     [] {
       return lamp_over_floor(0, {blob({0, 3, 0}, 0.7, 0.4)});
     },
     0, 0},
    {"dense_cloud_about_the_lamp",
     [] {
       return lamp_over_floor(0, {blob({0, 3, 0}, 0.7, 3)});
     },
     0, 0},
    {"thin_blob_on_the_floor",
     [] {
       return lamp_over_floor(0, {blob({0, 0.3, 0}, 0.7, 0.4)});
     },
     0, 0},
    {"dense_blob_beside_the_way",
     [] {
       return lamp_over_floor(0, {blob({2.2, 1.2, 0}, 0.6, 4)});
     },
     0, 0},
    {"dense_blob_above_the_lamp",
     [] {
       return lamp_over_floor(0, {blob({0, 4.2, 0}, 0.6, 4)});
     },
     0, 0},
    {"thin_wide_cloud",
     [] {
       return lamp_over_floor(0, {blob({0, 1.5, 0}, 4, 0.1)});
     },
     0, 0},
    {"dense_wide_cloud",
     [] {
       return lamp_over_floor(0, {blob({0, 1.5, 0}, 4, 0.5)});
     },
     0, 0},
    {"eight_thin_blobs", [] { return lamp_over_floor(0, ring_of_eight(0.4)); }, 0, 0},
    {"eight_dense_blobs", [] { return lamp_over_floor(0, ring_of_eight(3)); }, 0, 0},
    {"eight_thin_blobs_in_fog", [] { return lamp_over_floor(0.1, ring_of_eight(0.4)); }, 0, 0},
    {"lattice_of_27_thin", [] { return lamp_over_floor(0, lattice_of_27(0.15)); }, 0, 0},
    {"lattice_of_27_dense", [] { return lamp_over_floor(0, lattice_of_27(0.8)); }, 0, 0},
    {"glossy_fog", [] { return lamp_over_floor(0.1, {}, glm::vec3(0.5F)); }, 0, 0},
    {"glossy_eight_thin_blobs", [] { return lamp_over_floor(0, ring_of_eight(0.4), glm::vec3(0.5F)); }, 0, 0},
};
class IndirectGaussiansTable : public testing::TestWithParam<Place> {};
TEST_P(IndirectGaussiansTable, DISABLED_ModelsBesideExact) { compare(GetParam(), {3, 2}, 5e-2, false); }
INSTANTIATE_TEST_SUITE_P(Gaussians, IndirectGaussiansTable, testing::ValuesIn(table), [](const auto& test) {
  std::string name(test.param.name);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

}  // namespace
}  // namespace airlight
