#include "common/plan/sweep.h"

#include <algorithm>

namespace airlight {

namespace {

struct Keyed {
  double key;
  std::uint32_t number;
};

// Numbers 0, 1 ... with what `key` gives of them, in its order; equals in their own.
template <class Key>
std::vector<Keyed> sorted_by(std::size_t count, Key&& key) {
  std::vector<Keyed> all;
  all.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) all.push_back({key(i), i});
  std::sort(all.begin(), all.end(),
            [](const Keyed& a, const Keyed& b) { return a.key < b.key || (!(b.key < a.key) && a.number < b.number); });
  return all;
}

std::vector<std::uint32_t> numbers(const std::vector<Keyed>& sorted) {
  std::vector<std::uint32_t> all;
  all.reserve(sorted.size());
  for (const Keyed& k : sorted) all.push_back(k.number);
  return all;
}

}  // namespace

Sweep::Sweep(std::span<const SweptPoint> points, std::span<const SweptBox> boxes) : points_(points), boxes_(boxes) {
  order_ = numbers(sorted_by(points.size(), [&](std::uint32_t i) { return points[i].along; }));
  beginning_ = numbers(sorted_by(boxes.size(), [&](std::uint32_t i) { return boxes[i].along.least; }));
  ending_ = numbers(sorted_by(boxes.size(), [&](std::uint32_t i) { return boxes[i].along.most; }));
  const std::vector<Keyed> across = sorted_by(points.size(), [&](std::uint32_t i) { return points[i].across; });
  rank_.resize(points.size());
  for (std::size_t i = 0; i < across.size(); ++i) rank_[across[i].number] = static_cast<std::uint32_t>(i);
  while (leaves_ < points.size()) leaves_ *= 2;

  // Each box covers the leaves of a run of ranks: its entries are the fewest nodes that make up the run.
  nodes_.assign(2 * leaves_, {0, 0});
  for (const SweptBox& box : boxes) {
    entries_of_.push_back(static_cast<std::uint32_t>(entries_.size()));
    if (!(box.across.least <= box.across.most) || !(box.along.least <= box.along.most)) continue;
    const auto from = std::lower_bound(across.begin(), across.end(), box.across.least,
                                       [](const Keyed& k, double least) { return k.key < least; });
    const auto to =
        std::upper_bound(from, across.end(), box.across.most, [](double most, const Keyed& k) { return most < k.key; });
    const auto add = [&](std::size_t node) {
      entries_.push_back({static_cast<std::uint32_t>(node), 0});
      ++nodes_[node].count;
    };
    std::size_t left = leaves_ + static_cast<std::size_t>(from - across.begin());
    std::size_t right = leaves_ + static_cast<std::size_t>(to - across.begin());
    for (; left < right; left /= 2, right /= 2) {
      if (left % 2 == 1) add(left++);
      if (right % 2 == 1) add(--right);
    }
  }
  entries_of_.push_back(static_cast<std::uint32_t>(entries_.size()));
  std::uint32_t slots = 0;
  for (Node& node : nodes_) {
    node.first = slots;
    slots += node.count;
    node.count = 0;
  }
  slots_.resize(slots);
}

// To this point: in is what holds its place along the sweep.
void Sweep::advance(std::uint32_t point) {
  const double at = points_[point].along;
  for (; begun_ < beginning_.size() && boxes_[beginning_[begun_]].along.least <= at; ++begun_) insert(beginning_[begun_]);
  for (; ended_ < ending_.size() && boxes_[ending_[ended_]].along.most < at; ++ended_) remove(ending_[ended_]);
}

void Sweep::insert(std::uint32_t box) {
  for (std::uint32_t e = entries_of_[box]; e < entries_of_[box + 1]; ++e) {
    Node& node = nodes_[entries_[e].node];
    entries_[e].slot = node.first + node.count++;
    slots_[entries_[e].slot] = {e, boxes_[box].owner};
  }
}

// The last entry of each node takes the place of the one that leaves.
void Sweep::remove(std::uint32_t box) {
  for (std::uint32_t e = entries_of_[box]; e < entries_of_[box + 1]; ++e) {
    Node& node = nodes_[entries_[e].node];
    const Slot last = slots_[node.first + --node.count];
    slots_[entries_[e].slot] = last;
    entries_[last.entry].slot = entries_[e].slot;
  }
}

}  // namespace airlight
