// Which steps of a run the CPU backend takes together, tile by tile, and what is held of their images.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/algorithms/algorithm.h"
#include "common/plan/keys.h"
#include "common/plan/rows.h"
#include "cpu/held_images.h"

namespace airlight {

// Steps that run together, tile by tile: at most one that is not Domain::pixel, at the head. Neighbours in the list of those that
// run.
struct Group {
  std::span<const std::size_t> steps;
  Extent extent;
  StepRows rows;
};

// What is held of an image: what is kept, or handed from one group to another.
struct HeldPart {
  Image image;
  Rows rows;
};

// What a group touches: whole images (or the rows of them that are held), else a place in each worker's scratch.
struct Place {
  std::uint32_t id;
  HeldImage* whole;
  bool other;  // of another extent
  std::size_t offset;
  int first_tile;  // of the group's among those that are held
};

// What a run() needs meanwhile, kept for its memory: warm frames allocate nothing.
struct Meanwhile {
  StepRuns runs;
  std::vector<StepRows> rows;
  std::vector<std::size_t> running;  // steps, in order
  std::vector<Group> groups;
  std::vector<std::pair<Handle, std::size_t>> writers;  // the group that makes an image
  std::vector<HeldPart> held;                           // what is kept, and what one group hands to another
  std::vector<Place> places;
  std::vector<std::pair<std::uint32_t, std::span<const std::byte>>> inputs;

  // Of the steps that run, with `rows` as they are.
  void find_groups(std::span<const Step>, const std::vector<bool>& run, bool fuse);
  // Of the groups' images.
  void find_held(std::span<const Step>);
};

}  // namespace airlight
