#include "tests/parity/inputs.h"
#include "tests/parity/medium.h"

namespace airlight {

namespace {

struct Parts {
  float extinction = 0.06F;
  int gaussians = 0;
  bool grid = false;
  int steps = 16, light_steps = 8;
  LightDepth light_depth = LightDepth::analytic;
  Phase phase = {PhaseKind::henyey_greenstein, 0.4};
  float sky_distance = 1e30F;
  bool parts = true;  // per light, optical depth
  bool casters = false;
  bool sources = false, sparse = false;
};  // namespace

// A table of source_in_volume().
Buffer add_sources(Case& c, std::uint32_t id, bool sparse) {
  std::vector<float> table{4, 3, 5, 2, 1, 1, 1, 9, 0};
  std::uint32_t bricks = 1;
  if (sparse) {  // 2 x 2 x 3 bricks, of which some have no nodes
    table = {4, 3, 5, 2, 2, 2, 3, 20, 0, -1, 1, 2, -1, 3, 4, 5, 6, 7, -1, 8};
    bricks = 9;
  }
  for (std::uint32_t i = 0; i < bricks * 3 * 4 * 3 * 5; ++i) table.push_back(2 * static_cast<float>(uniform(173, i)));
  const auto bytes = std::as_bytes(std::span(table));
  const Buffer sources{{id}, bytes.size()};
  c.buffers.emplace_back(sources, std::vector<std::byte>(bytes.begin(), bytes.end()));
  return sources;
}

Case march(Extent extent, const Parts& parts) {
  Case c;
  const View view = test_view(extent);
  const TestSurfaces surfaces = sphere_on_plane(view, 1);
  add_to(c, surfaces);
  TestMedium medium;
  medium.gaussians = test_gaussians(parts.gaussians);
  if (parts.grid) add_test_grid(medium, c, 4);
  const std::vector<Light> lights = test_lights();
  const Image total{{5}, Format::rgb32f, extent, 1, true};
  const Image through{{6}, Format::r32f, extent, 1, true};
  const Image each{{7}, Format::rgb32f, extent, static_cast<int>(lights.size()), true};
  const Image depth{{8}, Format::r32f, extent, 1, true};
  c.steps = {{RayMarch{.distance = surfaces.distance,
                       .voxels = medium.voxels,
                       .volumes = parts.casters ? add_test_volumes(c, 9, lights) : Buffer{},
                       .depths = {},
                       .sources = parts.sources ? add_sources(c, 10, parts.sparse) : Buffer{},
                       .lights = lights,
                       .depth_volumes = {},
                       .gaussians = medium.gaussians,
                       .grid = medium.grid,
                       .view = view,
                       .phase = parts.phase,
                       .extinction = parts.extinction,
                       .sky_distance = parts.sky_distance,
                       .albedo = {0.9F, 0.8F, 0.7F},
                       .ambient = {0.01F, 0.02F, 0.03F},
                       .emission = {0.003F, 0.002F, 0.001F},
                       .steps = parts.steps,
                       .light_steps = parts.light_steps,
                       .light_depth = parts.light_depth,
                       .source_first = {-2, -1.5F, -8},
                       .source_spacing = {1.5F, 1.2F, 1.3F},
                       .airlight = total,
                       .per_light = parts.parts ? each : Image{},
                       .transmittance = through,
                       .optical_depth = parts.parts ? depth : Image{}},
              ""}};
  c.results = {{"airlight", total}, {"transmittance", through}};
  if (parts.parts) c.results.insert(c.results.end(), {{"per_light", each}, {"optical_depth", depth}});
  return c;
}

constexpr LightDepth marched = LightDepth::march;

const NamedCase cases[] = {
    {"ray_march/homogeneous", [](Extent e) { return march(e, {.parts = false}); }},
    {"ray_march/dense", [](Extent e) { return march(e, {.extinction = 20, .phase = {}}); }},
    {"ray_march/glow_without_extinction",
     [](Extent e) { return march(e, {.extinction = 0, .gaussians = 2, .sky_distance = 50}); }},
    {"ray_march/gaussians", [](Extent e) { return march(e, {.gaussians = 7, .steps = 6, .parts = false}); }},
    {"ray_march/gaussians_marched",
     [](Extent e) { return march(e, {.extinction = 0, .gaussians = 5, .light_depth = marched, .sky_distance = 100}); }},
    {"ray_march/many_gaussians", [](Extent e) { return march(e, {.gaussians = 132, .steps = 1, .parts = false}); }},
    {"ray_march/grid", [](Extent e) { return march(e, {.extinction = 0, .grid = true, .phase = {}, .sky_distance = 100}); }},
    {"ray_march/casters", [](Extent e) { return march(e, {.steps = 12, .casters = true}); }},
    {"ray_march/casters_in_everything",
     [](Extent e) { return march(e, {.gaussians = 4, .grid = true, .steps = 6, .casters = true}); }},
    {"ray_march/sources", [](Extent e) { return march(e, {.gaussians = 4, .grid = true, .steps = 6, .sources = true}); }},
    {"ray_march/sparse_sources",
     [](Extent e) { return march(e, {.gaussians = 4, .grid = true, .steps = 6, .sources = true, .sparse = true}); }},
    {"ray_march/everything",
     [](Extent e) { return march(e, {.gaussians = 4, .grid = true, .steps = 6, .light_depth = marched}); }},
};

// More rounds than llvmpipe's loops may make at once: several dispatches, by steps and by lights.
const NamedCase in_parts[] = {
    {"ray_march/steps_in_parts",
     [](Extent e) { return march(e, {.gaussians = 3, .steps = 96, .light_steps = 192, .light_depth = marched}); }},
    {"ray_march/casters_in_parts",
     [](Extent e) {
       return march(e, {.gaussians = 6, .steps = 24, .light_steps = 600, .light_depth = marched, .casters = true});
     }},
    {"ray_march/lights_in_parts",
     [](Extent e) { return march(e, {.gaussians = 12, .steps = 2, .light_steps = 1500, .light_depth = marched}); }},
};

}  // namespace

std::span<const NamedCase> ray_march_cases() { return cases; }
std::span<const NamedCase> long_ray_march_cases() { return in_parts; }

}  // namespace airlight
