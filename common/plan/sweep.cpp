#include "common/plan/sweep.h"

#include <algorithm>
#include <numeric>

namespace airlight {

namespace {

// Numbers 0, 1 ... in the order of what `key` gives of them; equals in their own.
template <class Key>
std::vector<std::uint32_t> sorted_by(std::size_t count, Key&& key) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  std::stable_sort(numbers.begin(), numbers.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  return numbers;
}

}  // namespace

Sweep::Sweep(std::span<const SweptPoint> points, std::span<const SweptBox> boxes) : points_(points), boxes_(boxes) {
  order_ = sorted_by(points.size(), [&](std::uint32_t i) { return points[i].along; });
  beginning_ = sorted_by(boxes.size(), [&](std::uint32_t i) { return boxes[i].along.least; });
  ending_ = sorted_by(boxes.size(), [&](std::uint32_t i) { return boxes[i].along.most; });
  const std::vector<std::uint32_t> across = sorted_by(points.size(), [&](std::uint32_t i) { return points[i].across; });
  rank_.resize(points.size());
  for (std::size_t i = 0; i < across.size(); ++i) rank_[across[i]] = static_cast<std::uint32_t>(i);
  while (leaves_ < points.size()) leaves_ *= 2;

  // Each box covers the leaves of a run of ranks: its entries are the fewest nodes that make up the run.
  first_.assign(2 * leaves_ + 1, 0);
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    entries_of_.push_back(entries_.size());
    const SweptRange& held = boxes[b].across;
    if (!(held.least <= held.most) || !(boxes[b].along.least <= boxes[b].along.most)) continue;
    const auto from = std::lower_bound(across.begin(), across.end(), held.least,
                                       [&](std::uint32_t i, double least) { return points[i].across < least; });
    const auto to = std::upper_bound(across.begin(), across.end(), held.most,
                                     [&](double most, std::uint32_t i) { return most < points[i].across; });
    const auto add = [&](std::size_t node) {
      entries_.push_back({static_cast<std::uint32_t>(node), 0});
      ++first_[node + 1];
    };
    std::size_t left = leaves_ + static_cast<std::size_t>(from - across.begin());
    std::size_t right = leaves_ + static_cast<std::size_t>(to - across.begin());
    for (; left < right; left /= 2, right /= 2) {
      if (left % 2 == 1) add(left++);
      if (right % 2 == 1) add(--right);
    }
  }
  entries_of_.push_back(entries_.size());
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  slots_.resize(entries_.size());
  count_.assign(2 * leaves_, 0);
}

// To this point: in is what holds its place along the sweep.
void Sweep::advance(std::uint32_t point) {
  const double at = points_[point].along;
  for (; begun_ < beginning_.size() && boxes_[beginning_[begun_]].along.least <= at; ++begun_) insert(beginning_[begun_]);
  for (; ended_ < ending_.size() && boxes_[ending_[ended_]].along.most < at; ++ended_) remove(ending_[ended_]);
}

void Sweep::insert(std::uint32_t box) {
  for (std::size_t e = entries_of_[box]; e < entries_of_[box + 1]; ++e) {
    Entry& entry = entries_[e];
    entry.slot = count_[entry.node]++;
    slots_[first_[entry.node] + entry.slot] = {static_cast<std::uint32_t>(e), boxes_[box].owner};
  }
}

// The last entry of each node takes the place of the one that leaves.
void Sweep::remove(std::uint32_t box) {
  for (std::size_t e = entries_of_[box]; e < entries_of_[box + 1]; ++e) {
    const Entry& entry = entries_[e];
    const Slot last = slots_[first_[entry.node] + --count_[entry.node]];
    slots_[first_[entry.node] + entry.slot] = last;
    entries_[last.entry].slot = entry.slot;
  }
}

}  // namespace airlight
