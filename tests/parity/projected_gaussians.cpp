#include "common/plan/airlight_tables.h"
#include "common/plan/depths_to_centers.h"
#include "common/plan/gaussian_bins.h"
#include "tests/parity/inputs.h"
#include "tests/parity/medium.h"

namespace airlight {

namespace {

struct Parts {
  float extinction = 0;
  int gaussians = 7;
  Phase phase = {PhaseKind::henyey_greenstein, 0.4};
  float sky_distance = 100;
  bool parts = true;  // per light, optical depth
  std::vector<Light> lights = test_lights();
  Erf erf = Erf::accurate;
  double spread = 1;  // their centres' distance from the camera, beside what it is; below 1 it stands among them
};

template <class T>
Buffer add(Case& c, std::uint32_t id, const std::vector<T>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  c.buffers.emplace_back(Buffer{{id}, bytes.size()}, std::vector<std::byte>(bytes.begin(), bytes.end()));
  return c.buffers.back().first;
}

// Of so many that all stand in each other's way, where any numbers will do.
std::vector<float> invented(std::size_t count) {
  std::vector<float> depths;
  for (std::uint32_t i = 0; i < count; ++i) depths.push_back(static_cast<float>(3 * uniform(180, i)));
  return depths;
}

std::vector<float> others(std::vector<GaussianDensity> gaussians, const Light* light) {
  if (gaussians.size() > 1000) return invented(gaussians.size());
  if (light && !light->directional) {
    for (GaussianDensity& g : gaussians) g.center -= light->vector;
  }
  const CenterDepths d = light && light->directional ? depths_to_centers(gaussians, light->vector) : depths_to_centers(gaussians);
  return {d.others.begin(), d.others.end()};
}

Case project(Extent extent, const Parts& parts) {
  Case c;
  const View view = test_view(extent);
  const TestSurfaces surfaces = sphere_on_plane(view, 1);
  add_to(c, surfaces);
  std::vector<GaussianDensity> gaussians = test_gaussians(parts.gaussians);
  for (GaussianDensity& g : gaussians) g.center *= static_cast<float>(parts.spread);
  std::vector<Buffer> to_light;
  std::vector<float> light_to_camera;
  for (const Light& light : parts.lights) {
    to_light.push_back(add(c, static_cast<std::uint32_t>(20 + to_light.size()), others(gaussians, &light)));
    const double depth =
        light.directional ? depth_toward(gaussians, -glm::dvec3(light.vector)) : depth_to(gaussians, light.vector);
    light_to_camera.push_back(static_cast<float>(depth));
  }
  const Image total{{5}, Format::rgb32f, extent, 1, true};
  const Image through{{6}, Format::r32f, extent, 1, true};
  const bool layers = parts.parts && !parts.lights.empty();
  const Image each{{7}, Format::rgb32f, extent, std::max(1, static_cast<int>(parts.lights.size())), true};
  const Image depth{{8}, Format::r32f, extent, 1, true};
  c.steps = {{ProjectedGaussians{.distance = surfaces.distance,
                                 .tables = parts.extinction > 0 ? add(c, 4, airlight_tables(parts.phase, 64)) : Buffer{},
                                 .bins = add(c, 9, gaussian_bins(view, gaussians)),
                                 .to_camera = add(c, 10, others(gaussians, nullptr)),
                                 .to_light = to_light,
                                 .light_to_camera = light_to_camera.empty() ? Buffer{} : add(c, 11, light_to_camera),
                                 .lights = parts.lights,
                                 .gaussians = gaussians,
                                 .view = view,
                                 .phase = parts.phase,
                                 .extinction = parts.extinction,
                                 .sky_distance = parts.sky_distance,
                                 .albedo = {0.9F, 0.8F, 0.7F},
                                 .ambient = {0.01F, 0.02F, 0.03F},
                                 .emission = {0.003F, 0.002F, 0.001F},
                                 .erf = parts.erf,
                                 .airlight = total,
                                 .per_light = layers ? each : Image{},
                                 .transmittance = through,
                                 .optical_depth = parts.parts ? depth : Image{}},
              ""}};
  c.results = {{"airlight", total}, {"transmittance", through}};
  if (layers) c.results.emplace_back("per_light", each);
  if (parts.parts) c.results.emplace_back("optical_depth", depth);
  return c;
}

// More lights than OpenGL takes in one pass, one of them in the middle of a Gaussian.
std::vector<Light> six_lights() {
  std::vector<Light> lights = test_lights();
  const std::vector<GaussianDensity> gaussians = test_gaussians(3);
  lights.push_back({.vector = gaussians[0].center, .power = {3, 4, 5}});
  lights.push_back({.vector = gaussians[2].center + glm::vec3(0.1F, 0.5F, 0.2F), .power = {9, 3, 1}});
  lights.push_back({.vector = glm::normalize(glm::vec3(-0.5F, -0.2F, -1)), .power = {0.2F, 0.3F, 0.2F}, .directional = true});
  return lights;
}

const NamedCase cases[] = {
    {"projected_gaussians/seven", [](Extent e) { return project(e, {.parts = false}); }},
    {"projected_gaussians/fast_erf", [](Extent e) { return project(e, {.parts = false, .erf = Erf::fast}); }},
    {"projected_gaussians/in_fog", [](Extent e) { return project(e, {.extinction = 0.06F, .sky_distance = 1e30F}); }},
    {"projected_gaussians/six_lights", [](Extent e) { return project(e, {.extinction = 0.03F, .lights = six_lights()}); }},
    {"projected_gaussians/no_light", [](Extent e) { return project(e, {.lights = {}}); }},
    {"projected_gaussians/camera_within", [](Extent e) { return project(e, {.extinction = 0.02F, .spread = 0.1}); }},
    {"projected_gaussians/many",
     [](Extent e) { return project(e, {.gaussians = 140, .phase = {}, .parts = false, .lights = {test_lights()[0]}}); }},
};

// A list that is longer than one dispatch of OpenGL may be.
const NamedCase in_parts[] = {
    {"projected_gaussians/in_parts",
     [](Extent e) { return project(e, {.extinction = 0.01F, .gaussians = 12000, .lights = {test_lights()[0]}, .spread = 0.2}); }},
};

}  // namespace

std::span<const NamedCase> projected_gaussians_cases() { return cases; }
std::span<const NamedCase> long_projected_gaussians_cases() { return in_parts; }

}  // namespace airlight
