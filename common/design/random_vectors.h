// Random vectors without functions of the C library, by rejection.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/random.h"

namespace airlight {

// Uniform in the open unit disk.
inline glm::dvec2 in_disk(Random& random) {
  for (;;) {
    const double x = 2 * random.next() - 1, y = 2 * random.next() - 1;
    if (x * x + y * y < 1) return {x, y};
  }
}

// Uniform in the open unit ball.
inline glm::dvec3 in_ball(Random& random) {
  for (;;) {
    const double x = 2 * random.next() - 1, y = 2 * random.next() - 1, z = 2 * random.next() - 1;
    if (x * x + y * y + z * z < 1) return {x, y, z};
  }
}

// Uniform in the cube -1 to 1.
inline glm::dvec3 in_cube(Random& random) {
  const double x = 2 * random.next() - 1, y = 2 * random.next() - 1, z = 2 * random.next() - 1;
  return {x, y, z};
}

// What an edit's random numbers are drawn with: no two tools share a stream.
enum class Stream : std::uint32_t { paint = 1, airbrush = 2, emitter = 3 };
inline Random random_of(Stream stream, std::int64_t seed, std::uint64_t number) {
  return Random({static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(stream)}, number);
}

}  // namespace airlight
