// From the planes that the rays of a tile cross to the parts of the rays that a light reaches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cpu/held_images.h"
#include "cpu/tile.h"

namespace airlight {

// Where rays cross planes in one tile, one light at a time. Memory of a worker: it grows to what the fullest tile needs.
struct Crossings {
  static constexpr std::uint32_t change_offset = 1U << 17U;

  // In the order of the planes: 1/z, and pixel + tile_pixels * (change + change_offset).
  std::vector<float> k;
  std::vector<std::uint32_t> where;
  std::size_t count = 0;

  // By pixel, from begin[p] to begin[p + 1]; in the order of the planes, or of distance.
  struct One {
    float k;
    std::int32_t change;
  };
  std::vector<One> of_pixel;
  std::vector<std::uint32_t> begin;

  // The lit parts [m] by pixel, from first_part[p] to first_part[p + 1]. One whose `to` lies before its `from` counts negative.
  std::vector<float> from, to;
  std::vector<std::uint32_t> first_part;

  AlignedFloats rays;  // per pixel: length of the ray [m]; length over z; 1/z of its end
};

// The lit parts of one light over a tile.
struct LitParts {
  enum class Rays : int { lit, dark, mixed };  // mixed: some ray crosses a plane, and the lists tell
  Rays rays = Rays::lit;
  std::vector<float> from, to;  // [m], as in Crossings
  std::vector<std::uint32_t> first_part;
};

// The lit parts of a vector of rays, as cpu/lit_rays.h lays them out.
struct LitScratch {
  AlignedFloats floats;
  std::vector<std::uint32_t> first, at;
};

// From the order of planes to pixel by pixel; in each it stays.
void by_pixel(Crossings&);

// The crossings of each pixel, nearest first.
void sort_by_distance(Crossings&);

// The lit parts between crossings sorted by distance. `covering`: triangles between the camera and the light. `lit`, if not null:
// 1 by pixel where the ray's end is lit, else 0.
void find_parts(Crossings&, std::int64_t covering, float* lit);

// What ShadowOrder::published adds, as parts from the camera, and what it subtracts, as parts to the camera: of crossings back to
// front, plane by plane.
void find_published_parts(Crossings&, std::int64_t covering, float* lit);

}  // namespace airlight
