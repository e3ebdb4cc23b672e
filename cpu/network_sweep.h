// Light along the lists of an illumination network on the CPU: four lists side by side, three channels and an unused one each, so
// that a vector holds one to four lists and no list knows of its neighbours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cpu/network_links.h"
#include "cpu/targets.h"

namespace airlight {

constexpr std::size_t lists_abreast = 4;

// Four lists of a bundle, of nearly the same length. Links beyond a list's end do nothing.
struct ListBlock {
  std::size_t ends, shares;   // where they begin in LineLists
  int links;                  // of the longest
  float last[lists_abreast];  // number of the last link of each
  float area[lists_abreast];  // of each (Links::area())
};

// The lists of one bundle in the order in which they are swept. Links go from end k to end k + 1 of ends: the particles, the
// first and the last of which are their own neighbours outside; what is not there is particle number `particles`, which sends
// nothing.
struct LineLists {
  std::vector<ListBlock> blocks;
  std::vector<std::int32_t> ends;  // of each block, links + 1 times four
  std::vector<float> shares;       // of each block, links times lost of four lists, given, kept
  std::size_t most = 0;            // links

  LineLists() = default;
  LineLists(const Links&, const float* masses, std::size_t particles);
  std::size_t scratch_floats() const { return 2 * 4 * lists_abreast * (most + 1); }
};

// What particles take of the light along all lists, times the list's area, is added to `taken`. Sources and what is taken are
// rgb and an unused float a particle, with one particle more than there are; so is `sky`, what light begins with each way.
void sweep_both_ways(const LineLists&, const float* source, const float* sky, float* scratch, float* taken, Simd);
void sweep_one_way(const LineLists&, bool backward, const float* source, const float* sky, float* taken, Simd);

}  // namespace airlight
