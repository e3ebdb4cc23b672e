#include "bench/pareto/labels.h"

#include <algorithm>
#include <array>
#include <utility>

namespace airlight {

namespace {

// Left, centre and right of the point, above, beside and below it, one ring of places after the other.
std::vector<Box> places(const Label& l) {
  std::vector<Box> all;
  for (int ring = 0; ring < 5; ++ring) {
    const double apart = 7 + 11 * ring;  // [pixel] from the point to the text
    const std::array<double, 2> sides{l.x + apart * 0.8, l.x - apart * 0.8 - l.width};
    const std::array<double, 2> levels{l.y - apart - l.height * 0.6, l.y + apart - l.height * 0.4};
    for (const double level : levels) {
      for (const double side : sides) all.push_back({side, level, l.width, l.height});
    }
    for (const double side : sides) all.push_back({side, l.y - l.height / 2, l.width, l.height});
    if (ring == 0) continue;  // the text would lie on the point
    for (const double level : levels) all.push_back({l.x - l.width / 2, level, l.width, l.height});
  }
  return all;
}

}  // namespace

std::vector<std::optional<Box>> placed(const std::vector<Label>& labels, std::vector<Box> taken, const Box& area) {
  std::vector<std::optional<Box>> all;
  for (const Label& label : labels) {
    all.emplace_back();
    for (const Box& place : places(label)) {
      if (!place.inside(area)) continue;
      if (std::any_of(taken.begin(), taken.end(), [&](const Box& t) { return t.meets(place); })) continue;
      all.back() = place;
      taken.push_back(place);
      break;
    }
  }
  return all;
}

}  // namespace airlight
