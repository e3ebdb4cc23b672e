#include "common/algorithms/depth_aware_upsample.h"

#include <algorithm>
#include <cmath>

#include "common/algorithms/subsample.h"
#include "tests/parity/inputs.h"

namespace airlight {

namespace {

// Fog about a sphere on a plane, a halo, and a shaft of light with a sharp edge.
Case fog(Extent extent, int stride, bool per_light) {
  Case c;
  const View view = test_view(extent);
  const TestSurfaces surfaces = sphere_on_plane(view, 1);
  add_to(c, surfaces);
  const Extent few = subsampled(extent, stride);
  const int lights = 3;
  DepthAwareUpsample a{.distance = surfaces.distance,
                       .sampled_distance = {{4}, Format::r32f, few, 1, false},
                       .sampled_airlight = {{5}, Format::rgb32f, few, 1, false},
                       .sampled_per_light = {},
                       .sampled_transmittance = {{7}, Format::r32f, few, 1, false},
                       .stride = stride,
                       .remaining = {{8}, Format::r32f, extent, 1, true},
                       .airlight = {{9}, Format::rgb32f, extent, 1, true},
                       .per_light = {},
                       .transmittance = {{11}, Format::r32f, extent, 1, true}};
  if (per_light) {
    a.sampled_per_light = {{6}, Format::rgb32f, few, lights, false};
    a.per_light = {{10}, Format::rgb32f, extent, lights, true};
  }
  std::vector<float> distances, airlight, through, layers;
  for (int layer = 0; layer < (per_light ? lights : 1); ++layer) {
    for (int j = 0; j < few.height; ++j) {
      for (int i = 0; i < few.width; ++i) {
        const double x = (stride * i + 0.5) / extent.width, y = (stride * j + 0.5) / extent.height;
        const float distance = surfaces.distances[static_cast<std::size_t>(stride * j) * static_cast<std::size_t>(extent.width) +
                                                  static_cast<std::size_t>(stride * i)];
        const double transmittance = std::exp(-0.1 * std::min(static_cast<double>(distance), 400.0));
        const double halo = 0.05 / (0.02 + (x - 0.7) * (x - 0.7) + (y - 0.3) * (y - 0.3));
        const double shaft = x + 0.4 * y > 0.45 ? 1 : 0.6;
        for (int channel = 0; channel < 3; ++channel) {
          const double value = (1 - transmittance) * shaft * (1 + halo * (channel + 1)) * (layer + 1);
          layers.push_back(static_cast<float>(value));
          if (layer == 0) airlight.push_back(static_cast<float>(value));
        }
        if (layer > 0) continue;
        distances.push_back(distance);
        through.push_back(static_cast<float>(transmittance));
      }
    }
  }
  c.images.emplace_back(a.sampled_distance, distances);
  c.images.emplace_back(a.sampled_airlight, airlight);
  c.images.emplace_back(a.sampled_transmittance, through);
  if (per_light) c.images.emplace_back(a.sampled_per_light, layers);
  c.steps = {{a, ""}};
  c.results = {{"remaining", a.remaining}, {"airlight", a.airlight}, {"transmittance", a.transmittance}};
  if (per_light) c.results.emplace_back("per_light", a.per_light);
  return c;
}

}  // namespace

std::span<const NamedCase> depth_aware_upsample_cases() {
  static constexpr NamedCase cases[] = {{"depth_aware_upsample/half", [](Extent e) { return fog(e, 2, false); }},
                                        {"depth_aware_upsample/quarter", [](Extent e) { return fog(e, 4, false); }},
                                        {"depth_aware_upsample/per_light", [](Extent e) { return fog(e, 2, true); }}};
  return cases;
}

}  // namespace airlight
