// Which boxes of a plane hold which of many points: a sweep over one axis with a segment tree over the other (O'Rourke 1998,
// Computational Geometry in C). O((n + m) log n + k) for n points, m boxes and k pairs of a point and a box that holds it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace airlight {

// [least, most], both ends included.
struct SweptRange {
  double least, most;
};

struct SweptBox {
  SweptRange along, across;  // along the sweep, and across it
  std::uint32_t owner;       // what a visitor is told
};

struct SweptPoint {
  double along, across;
};

class Sweep {
 public:
  // Of what outlives this; numbers that are not NaN. A range whose least is above its most holds nothing.
  Sweep(std::span<const SweptPoint>, std::span<const SweptBox>);

  // visit(point, owner) for every box that holds the point with this number; points in the order of the sweep, boxes in an order
  // that depends on nothing but points and boxes. Once.
  template <class Visit>
  void each(Visit&& visit) {
    for (const std::uint32_t point : order_) {
      advance(point);
      for (std::size_t node = leaves_ + rank_[point]; node > 0; node /= 2) {
        const Slot* held = slots_.data() + nodes_[node].first;
        for (std::uint32_t i = 0; i < nodes_[node].count; ++i) visit(point, held[i].owner);
      }
    }
  }

 private:
  // A box in a node that it covers, and its place among those that the sweep has reached.
  struct Entry {
    std::uint32_t node, slot;
  };
  struct Slot {
    std::uint32_t entry, owner;
  };
  struct Node {
    std::uint32_t first, count;  // of its slots; how many of the entries that these are for are in
  };

  void advance(std::uint32_t point);
  void insert(std::uint32_t box);
  void remove(std::uint32_t box);

  std::span<const SweptPoint> points_;
  std::span<const SweptBox> boxes_;
  std::size_t leaves_ = 1;                         // a power of two; node 1 is the root, below node i are 2 i and 2 i + 1
  std::vector<std::uint32_t> order_, rank_;        // points along the sweep; their places across it
  std::vector<std::uint32_t> beginning_, ending_;  // boxes by where they begin and end along the sweep
  std::size_t begun_ = 0, ended_ = 0;              // how many of them have
  std::vector<Entry> entries_;                     // box by box
  std::vector<std::uint32_t> entries_of_;          // where a box's begin, and where the last end
  std::vector<Node> nodes_;
  std::vector<Slot> slots_;  // of each node, those that are in before the others
};

}  // namespace airlight
