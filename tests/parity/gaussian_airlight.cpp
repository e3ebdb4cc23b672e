#include "common/plan/airlight_tables.h"
#include "common/plan/ray_noise.h"
#include "tests/parity/inputs.h"
#include "tests/parity/medium.h"

namespace airlight {

namespace {

struct Parts {
  float extinction = 0;
  int gaussians = 7;
  int samples = 4;
  Phase phase = {PhaseKind::henyey_greenstein, 0.4};
  float sky_distance = 100;
  bool parts = true;         // per light, optical depth
  bool lamp_within = false;  // a lamp at the centre of a Gaussian, others close to rays
  std::size_t lights = 3;
  bool dark = false;  // no light
  bool casters = false;
  Erf erf = Erf::accurate;
  float noise = 0;
};  // namespace

Case scatter(Extent extent, const Parts& parts) {
  Case c;
  const View view = test_view(extent);
  const TestSurfaces surfaces = sphere_on_plane(view, 1);
  add_to(c, surfaces);
  std::vector<GaussianDensity> gaussians = test_gaussians(parts.gaussians);
  const RayNoise noise{.amplitude = parts.noise, .scale = 0.4F, .offset = {3, 250.5F, 77}};
  widen(gaussians, noise);
  std::vector<Light> lights = test_lights();
  lights.resize(parts.dark ? 0 : parts.lights);
  if (parts.lamp_within) lights.push_back({.vector = gaussians.at(0).center, .power = {3, 4, 5}});
  Buffer tables;
  if (parts.extinction > 0) {
    const std::vector<float> values = airlight_tables(parts.phase, 64);
    const auto bytes = std::as_bytes(std::span(values));
    tables = {{4}, bytes.size()};
    c.buffers.emplace_back(tables, std::vector<std::byte>(bytes.begin(), bytes.end()));
  }
  const Image total{{5}, Format::rgb32f, extent, 1, true};
  const Image through{{6}, Format::r32f, extent, 1, true};
  const bool layers = parts.parts && !lights.empty();
  const Image each{{7}, Format::rgb32f, extent, std::max(1, static_cast<int>(lights.size())), true};
  const Image depth{{8}, Format::r32f, extent, 1, true};
  c.steps = {{GaussianAirlight{.distance = surfaces.distance,
                               .tables = tables,
                               .volumes = parts.casters ? add_test_volumes(c, 9, lights) : Buffer{},
                               .depths = {},
                               .lights = lights,
                               .depth_volumes = {},
                               .gaussians = gaussians,
                               .view = view,
                               .phase = parts.phase,
                               .extinction = parts.extinction,
                               .sky_distance = parts.sky_distance,
                               .albedo = {0.9F, 0.8F, 0.7F},
                               .ambient = {0.01F, 0.02F, 0.03F},
                               .emission = {0.003F, 0.002F, 0.001F},
                               .samples = parts.samples,
                               .erf = parts.erf,
                               .noise = noise,
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

const NamedCase cases[] = {
    {"gaussian_airlight/seven", [](Extent e) { return scatter(e, {.parts = false}); }},
    {"gaussian_airlight/fast_erf", [](Extent e) { return scatter(e, {.parts = false, .erf = Erf::fast}); }},
    {"gaussian_airlight/noise",
     [](Extent e) {
       return scatter(e,
                      {.extinction = 0.03F, .gaussians = 3, .samples = 2, .sky_distance = 1e30F, .parts = false, .noise = 0.5F});
     }},
    {"gaussian_airlight/in_fog", [](Extent e) { return scatter(e, {.extinction = 0.06F, .sky_distance = 1e30F}); }},
    {"gaussian_airlight/fog_alone",
     [](Extent e) { return scatter(e, {.extinction = 0.1F, .gaussians = 0, .sky_distance = 1e30F}); }},
    {"gaussian_airlight/glow_alone", [](Extent e) { return scatter(e, {.dark = true}); }},
    {"gaussian_airlight/lamp_within", [](Extent e) { return scatter(e, {.gaussians = 4, .samples = 2, .lamp_within = true}); }},
    {"gaussian_airlight/casters",
     [](Extent e) { return scatter(e, {.gaussians = 3, .samples = 2, .lamp_within = true, .casters = true}); }},
    {"gaussian_airlight/casters_in_fog",
     [](Extent e) {
       return scatter(
           e, {.extinction = 0.06F, .gaussians = 2, .samples = 2, .sky_distance = 1e30F, .parts = false, .casters = true});
     }},
    {"gaussian_airlight/sixteen_samples",
     [](Extent e) { return scatter(e, {.gaussians = 2, .samples = 16, .phase = {}, .parts = false}); }},
    {"gaussian_airlight/many",
     [](Extent e) { return scatter(e, {.gaussians = 132, .samples = 1, .parts = false, .lights = 1}); }},
};

// More rounds than llvmpipe's loops may make at once: several dispatches.
const NamedCase in_parts[] = {
    {"gaussian_airlight/in_parts",
     [](Extent e) { return scatter(e, {.extinction = 0.05F, .gaussians = 100, .samples = 12, .lamp_within = true}); }},
    {"gaussian_airlight/casters_in_parts",
     [](Extent e) {
       return scatter(e, {.extinction = 0.05F, .gaussians = 60, .samples = 12, .lamp_within = true, .casters = true});
     }},
};

}  // namespace

std::span<const NamedCase> gaussian_airlight_cases() { return cases; }
std::span<const NamedCase> long_gaussian_airlight_cases() { return in_parts; }

}  // namespace airlight
