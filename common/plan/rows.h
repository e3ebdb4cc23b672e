// Which rows of each image are made where a band of the picture is wanted: the bits of a pixel are those that it has in the
// whole picture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/algorithms/algorithm.h"
#include "common/rows.h"

namespace airlight {

// Band `number` (1..count) of `count` of a picture. They are disjoint, cover it, and are as high as each other to a multiple of
// 64 rows, which the CPU makes at once; where there are more of them than such multiples, to one row. 1 <= count <= height.
Rows band_of(int number, int count, int height);

struct StepRows {
  Rows computed;  // of the images that the step makes; none for a step that makes buffers alone
  Rows held;      // of all images of that extent, by any step: where each begins and ends in memory
};

// Of each step, so that every image that is kept has the rows `wanted`. What other images are asked for beyond them, an apron, is
// told by the steps that read them: samples around a pixel, for instance. Rows begin and end at multiples of `granule` or at the
// border, for squares of so many pixels are told as a whole.
std::vector<StepRows> rows_of(std::span<const Step>, Rows wanted, int granule);
// The same into a vector, for its memory: of whole pictures nothing is allocated.
void rows_of(std::span<const Step>, Rows wanted, int granule, std::vector<StepRows>& all);

// What of this the keys of steps have to tell (common/plan/keys.h): nothing of whole images.
std::uint64_t key_of(const StepRows&, int height);

}  // namespace airlight
