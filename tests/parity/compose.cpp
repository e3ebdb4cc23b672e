#include "tests/parity/inputs.h"

namespace airlight {

namespace {

Case random_images(Extent extent) {
  Case c;
  Image parts[2];
  for (std::uint32_t k = 0; k < 2; ++k) {
    parts[k] = {{k + 1}, Format::rgb32f, extent, 1, false};
    std::vector<float> values(parts[k].floats());
    for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(uniform(k, i) * 10);
    c.images.emplace_back(parts[k], std::move(values));
  }
  const Image beauty{{3}, Format::rgb32f, extent, 1, true};
  c.steps = {{Compose{parts[0], parts[1], beauty}, ""}};
  c.results = {{"beauty", beauty}};
  return c;
}

}  // namespace

std::span<const NamedCase> compose_cases() {
  static constexpr NamedCase cases[] = {{"compose/random", random_images}};
  return cases;
}

}  // namespace airlight
