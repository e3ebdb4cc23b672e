#include "common/algorithms/subsample.h"

#include "tests/parity/inputs.h"

namespace airlight {

namespace {

Case every(Extent extent, int stride) {
  Case c;
  const Image whole{{1}, Format::r32f, extent, 1, false};
  std::vector<float> values(whole.floats());
  for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(uniform(81, i) * 100);
  c.images.emplace_back(whole, std::move(values));
  const Image part{{2}, Format::r32f, subsampled(extent, stride), 1, true};
  c.steps = {{Subsample{.whole = whole, .stride = stride, .part = part}, ""}};
  c.results = {{"part", part}};
  return c;
}

}  // namespace

std::span<const NamedCase> subsample_cases() {
  static constexpr NamedCase cases[] = {{"subsample/second", [](Extent e) { return every(e, 2); }},
                                        {"subsample/fourth", [](Extent e) { return every(e, 4); }}};
  return cases;
}

}  // namespace airlight
