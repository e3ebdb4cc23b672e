#include "tests/parity/inputs.h"
#include "tests/parity/medium.h"

namespace airlight {

namespace {

Case march(Extent extent, int gaussians, bool grid, LightDepth light_depth, int light_steps, bool shadowed = false,
           Erf erf = Erf::accurate, bool with_depth = false) {
  Case c;
  const View view = test_view(extent);
  const TestSurfaces surfaces = sphere_on_plane(view, 1);
  add_to(c, surfaces);
  TestMedium medium;
  medium.gaussians = test_gaussians(gaussians);
  if (grid) add_test_grid(medium, c, 4);
  const std::vector<Light> lights = test_lights();
  const Image through{{5}, Format::r32f, extent, static_cast<int>(lights.size()), true};
  const Image toward{{7}, Format::r32f, extent, static_cast<int>(lights.size()), true};
  const Image lit{{6}, Format::r32f, extent, static_cast<int>(lights.size()), false};
  if (shadowed) {
    std::vector<float> values(lights.size() * surfaces.distances.size());
    for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = i % 7 < 3 ? 0.0F : 1.0F;
    c.images.emplace_back(lit, values);
  }
  c.steps = {{LightMarch{.distance = surfaces.distance,
                         .lit = shadowed ? lit : Image{},
                         .voxels = medium.voxels,
                         .depths = {},
                         .lights = lights,
                         .depth_volumes = {},
                         .gaussians = medium.gaussians,
                         .grid = medium.grid,
                         .view = view,
                         .light_steps = light_steps,
                         .light_depth = light_depth,
                         .erf = erf,
                         .light_transmittance = through,
                         .depth_toward_light = with_depth ? toward : Image{}},
              ""}};
  c.results = {{"light_transmittance", through}};
  if (with_depth) c.results.push_back({"depth_toward_light", toward});
  return c;
}

const NamedCase cases[] = {
    {"light_march/analytic", [](Extent e) { return march(e, 7, false, LightDepth::analytic, 1); }},
    {"light_march/fast_erf", [](Extent e) { return march(e, 7, false, LightDepth::analytic, 1, false, Erf::fast); }},
    {"light_march/shadowed", [](Extent e) { return march(e, 3, false, LightDepth::analytic, 1, true); }},
    {"light_march/depth_too", [](Extent e) { return march(e, 7, true, LightDepth::analytic, 8, true, Erf::accurate, true); }},
    {"light_march/marched", [](Extent e) { return march(e, 5, false, LightDepth::march, 16); }},
    {"light_march/grid", [](Extent e) { return march(e, 0, true, LightDepth::analytic, 24); }},
    {"light_march/everything", [](Extent e) { return march(e, 4, true, LightDepth::march, 16); }},
};

const NamedCase in_parts[] = {
    {"light_march/lights_in_parts", [](Extent e) { return march(e, 15, false, LightDepth::march, 1500); }},
};

}  // namespace

std::span<const NamedCase> light_march_cases() { return cases; }
std::span<const NamedCase> long_light_march_cases() { return in_parts; }

}  // namespace airlight
