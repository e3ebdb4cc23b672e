#include "common/algorithms/fill_airlight.h"

#include "tests/parity/inputs.h"

namespace airlight {

namespace {

Case fill(Extent extent, bool per_light) {
  Case c;
  std::uint32_t id = 1;
  const auto input = [&](Format format, int layers, bool sparse = false) {
    const Image image{{id++}, format, extent, layers, false};
    std::vector<float> values(image.floats());
    for (std::uint32_t i = 0; i < values.size(); ++i) {
      const double value = uniform(90 + image.id, i);
      values[i] = static_cast<float>(sparse && value < 0.7 ? 0 : value * 10);
    }
    c.images.emplace_back(image, std::move(values));
    return image;
  };
  FillAirlight a;
  a.remaining = input(Format::r32f, 1, true);
  a.upsampled = input(Format::rgb32f, 1);
  a.upsampled_transmittance = input(Format::r32f, 1);
  a.computed = input(Format::rgb32f, 1);
  a.computed_transmittance = input(Format::r32f, 1);
  a.airlight = {{id++}, Format::rgb32f, extent, 1, true};
  a.transmittance = {{id++}, Format::r32f, extent, 1, true};
  c.results = {{"airlight", a.airlight}, {"transmittance", a.transmittance}};
  if (per_light) {
    a.upsampled_per_light = input(Format::rgb32f, 3);
    a.computed_per_light = input(Format::rgb32f, 3);
    a.per_light = {{id++}, Format::rgb32f, extent, 3, true};
    c.results.emplace_back("per_light", a.per_light);
  }
  c.steps = {{a, ""}};
  return c;
}

}  // namespace

std::span<const NamedCase> fill_airlight_cases() {
  static constexpr NamedCase cases[] = {{"fill_airlight/random", [](Extent e) { return fill(e, false); }},
                                        {"fill_airlight/per_light", [](Extent e) { return fill(e, true); }}};
  return cases;
}

}  // namespace airlight
