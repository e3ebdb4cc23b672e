#include "common/plan/environment.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

// Depths from nothing to infinity, of which the fog before the sphere and the plane is a part.
Case scattered(Extent extent, EnvironmentScattering scattering, float extinction, float sky_distance) {
  Case c;
  const View view = test_view(extent);
  const TestSurfaces surfaces = sphere_on_plane(view, 1);
  add_to(c, surfaces);
  const Image depth{{4}, Format::r32f, extent, 1, false}, before{{5}, Format::rgb32f, extent, 1, false};
  std::vector<float> depths(depth.floats()), airlight(before.floats());
  for (std::uint32_t i = 0; i < depths.size(); ++i) {
    const float length = std::min(surfaces.distances[i], sky_distance);
    const double more = uniform(4, i) < 0.5 ? 0 : 4 * uniform(5, i);
    depths[i] = length >= 1e30F && extinction > 0 ? 1e30F
                : length >= 1e30F                 ? static_cast<float>(more)
                                                  : length * extinction + static_cast<float>(more);
  }
  for (std::uint32_t i = 0; i < airlight.size(); ++i) airlight[i] = static_cast<float>(uniform(6, i));
  c.images.emplace_back(depth, std::move(depths));
  c.images.emplace_back(before, std::move(airlight));
  std::vector<float> table;
  for (std::uint32_t i = 0; i < 108; ++i) table.push_back(static_cast<float>((i % 36 == 0 ? 2 : 0) + uniform(7, i) - 0.5));
  const auto bytes = std::as_bytes(std::span(table));
  const Buffer buffer{{6}, bytes.size()};
  c.buffers.emplace_back(buffer, std::vector<std::byte>(bytes.begin(), bytes.end()));
  const Image result{{7}, Format::rgb32f, extent, 1, true};
  c.steps = {{EnvironmentAirlight{.distance = surfaces.distance,
                                  .optical_depth = depth,
                                  .scattered = before,
                                  .tables = buffer,
                                  .view = view,
                                  .extinction = extinction,
                                  .sky_distance = sky_distance,
                                  .albedo = {0.9F, 0.8F, 0.7F},
                                  .gaussian_albedo = {0.5F, 1, 1},
                                  .scattering = scattering,
                                  .airlight = result},
              ""}};
  c.results = {{"airlight", result}};
  return c;
}

Case fog(Extent e) { return scattered(e, EnvironmentScattering::depths, 0.1F, 1e30F); }
Case clear(Extent e) { return scattered(e, EnvironmentScattering::depths, 0, 1e30F); }
Case published(Extent e) { return scattered(e, EnvironmentScattering::published, 0.1F, 20); }

}  // namespace

std::span<const NamedCase> environment_airlight_cases() {
  static constexpr NamedCase cases[] = {{"environment_airlight/fog_to_infinity", fog},
                                        {"environment_airlight/no_fog", clear},
                                        {"environment_airlight/published", published}};
  return cases;
}

}  // namespace airlight
