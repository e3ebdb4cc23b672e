// What becomes of the light that particles take, on the CPU: new sources of the scattering of an illumination network.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/algorithms/view.h"
#include "cpu/targets.h"

namespace airlight {

constexpr int particle_padding = 16;     // particles: the most lanes
constexpr std::size_t line_groups = 16;  // whatever the number of threads: sums over them have a fixed order

// Sums over sources, in an order that depends on neither threads nor lanes.
struct SourceChange {
  double change = 0, sum = 0;
  void add(const SourceChange& other) {
    change += other.change;
    sum += other.sum;
  }
};

// Of an isotropic phase function: rgb and an unused float a particle.
struct EvenScatter {
  const float* taken[line_groups];
  const float *factor, *first;
  float* sources;
};

// Both ways of a line have the same even part of what they send and the opposite odd one, and so has what they take: two matrices
// a quarter as large do for that from each direction to each. Tables are of `lines` rows of `row` floats; sources and first of
// twice as many.
struct DirectionScatter {
  const float *even, *odd;  // [from line][to line]
  const float *even_taken, *odd_taken;
  const float* rest;  // of a line and a particle: what of the even part of what it takes is sent evenly in all directions
  const float* first;
  float* sources;
  std::size_t lines, row;
  std::size_t odd_lines;  // as many, or none where the odd part is zero
};

constexpr int most_rows = 8;  // of the product, made at a time
struct ScatterScratch {
  std::vector<float> even, odd;  // what `lanes` particles take
  float evenly[48] = {};         // what they send in all directions, a channel after another
};

// Phase function from the lines' directions to that of line i, halves of the sum and of the difference of both ways.
void phase_row(const Phase&, const std::int32_t* lines, int count, int i, float* even, float* odd, Simd);
// New sources of elements begin .. end, multiples of 16.
SourceChange scatter_evenly(const EvenScatter&, std::size_t begin, std::size_t end, Simd);
// The even and the odd part of what particles have taken along a line and against it, times share (a particle) and albedo, of
// floats 0 .. row.
void split_taken(const float* along, const float* against, const float* share, const float* albedo, std::size_t row, float* even,
                 float* odd, Simd);
// New sources of the 16 particles from number `particle` on, in all directions.
SourceChange scatter_directions(const DirectionScatter&, std::size_t particle, ScatterScratch&, Simd);

}  // namespace airlight
