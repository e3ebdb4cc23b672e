#include "common/plan/rows.h"

#include <algorithm>
#include <map>
#include <utility>

#include "common/algorithms/each_field.h"
#include "common/plan/hash.h"

namespace airlight {

namespace {

// Rows of an input of that height that are read for the rows `made`, by a step whose own images are not as large.
template <class A>
Rows rows_read(const A&, Rows, int height) {
  return {0, height};
}
Rows rows_read(const Subsample& a, Rows made, int height) {
  return within({made.first * a.stride, (made.end - 1) * a.stride + 1}, height);
}
// Up to two samples above and below a pixel, three where it is below the last cell.
Rows rows_read(const DepthAwareUpsample& a, Rows made, int height) {
  return within({made.first / a.stride - 2, (made.end - 1) / a.stride + 3}, height);
}

// Adds what a step reads to what is needed, if it makes the rows `made` of images of that extent.
void add_needs(const Algorithm& what, Rows made, Extent extent, std::map<Handle, Rows>& needs) {
  std::visit(
      [&](const auto& a) {
        a.fields(a, [&](const Field& field, const auto& value) {
          if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Image>) {
            if (field.role != Role::input || !value) return;
            const Rows read = value.extent == extent ? made : rows_read(a, made, value.extent.height);
            const auto [need, is_first] = needs.try_emplace(value, read);
            if (!is_first) need->second = united(need->second, read);
          }
        });
      },
      what);
}

}  // namespace

Rows band_of(int number, int count, int height) {
  constexpr int side = 64;
  const int steps = (height + side - 1) / side;
  const auto border = [&](int k) {
    const std::int64_t of = count <= steps ? steps : height;
    const auto at = static_cast<int>(of * k / count);
    return count <= steps ? std::min(at * side, height) : at;
  };
  return {border(number - 1), border(number)};
}

std::vector<StepRows> rows_of(std::span<const Step> steps, Rows wanted, int granule) {
  std::vector<StepRows> all;
  rows_of(steps, wanted, granule, all);
  return all;
}

void rows_of(std::span<const Step> steps, Rows wanted, int granule, std::vector<StepRows>& all) {
  all.assign(steps.size(), StepRows{{0, 0}, {0, 0}});
  bool whole = true;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    each_made<Image>(steps[i].what, [&](const Image& image) {
      const Rows rows{0, image.extent.height};
      whole = whole && within(wanted, image.extent.height) == rows;
      all[i] = {rows, rows};
    });
  }
  if (whole) return;
  std::fill(all.begin(), all.end(), StepRows{{0, 0}, {0, 0}});
  std::map<Handle, Rows> needs;  // of images, by later steps
  std::map<std::pair<int, int>, Rows> held;
  const auto held_of = [&](Extent e) -> Rows& { return held.try_emplace({e.width, e.height}, Rows{0, 0}).first->second; };
  for (std::size_t i = steps.size(); i-- > 0;) {
    const std::vector<Image> made = outputs_of(steps[i].what);
    if (made.empty()) continue;
    const Extent extent = made[0].extent;
    Rows rows{0, 0};
    for (const Image& image : made) {
      if (image.keep) rows = united(rows, within(wanted, extent.height));
      if (const auto need = needs.find(image); need != needs.end()) {
        rows = united(rows, need->second);
        needs.erase(need);
      }
    }
    if (rows.count() == 0) continue;
    rows = within({rows.first / granule * granule, (rows.end + granule - 1) / granule * granule}, extent.height);
    all[i].computed = rows;
    held_of(extent) = united(held_of(extent), rows);
    add_needs(steps[i].what, rows, extent, needs);
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::vector<Image> made = outputs_of(steps[i].what);
    if (!made.empty()) all[i].held = held_of(made[0].extent);
  }
}

std::uint64_t key_of(const StepRows& rows, int height) {
  const Rows all{0, height};
  if (rows.computed == all && rows.held == all) return 0;
  Hash hash;
  hash.add(rows.computed.first), hash.add(rows.computed.end);
  hash.add(rows.held.first), hash.add(rows.held.end);
  return hash.value();
}

}  // namespace airlight
