// The lists of an illumination network on the CPU, and what particles send.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "common/algorithms/network.h"

namespace airlight {

// rgb and an unused fourth.
struct Rgb {
  float v[4] = {0, 0, 0, 0};
};

inline Rgb rgb_at(const float* values, std::size_t particle) {
  Rgb rgb;
  std::copy_n(values + 4 * particle, 4, rgb.v);
  return rgb;
}

inline void add(float* values, std::size_t particle, const Rgb& rgb, float weight) {
  for (std::size_t c = 0; c < 4; ++c) values[4 * particle + c] += weight * rgb.v[c];
}

// The links of one bundle of lines.
struct Links {
  const float *begin, *particle, *depth, *lost, *given, *kept;
  std::size_t slots;

  Links(const NetworkShape& shape, const float* links, std::size_t l)
      : begin(links + l * (shape.slots + 1)),
        particle(links + shape.record(l, link_particle)),
        depth(links + shape.record(l, link_depth)),
        lost(links + shape.record(l, link_lost)),
        given(links + shape.record(l, link_given)),
        kept(links + shape.record(l, link_kept)),
        slots(shape.slots) {}

  std::size_t particle_at(std::size_t record) const { return static_cast<std::size_t>(particle[record]); }

  // How much of the cross-section a list of n particles stands for: as much as makes its optical depth their mass, in the same
  // unit for all bundles. `masses`: the particles' plane of them.
  float area(std::size_t at, std::size_t n, const float* masses) const {
    float sum = 0, mass = 0;
    for (std::size_t k = at; k <= at + n; ++k) sum += depth[k];
    for (std::size_t k = at; k < at + n; ++k) mass += masses[particle_at(k)];
    return mass / std::max(sum, 1e-30F);
  }

  // body(first record, number of particles), of each list that has any.
  template <class Body>
  void each_list(Body&& body) const {
    for (std::size_t c = 0; c < slots; ++c) {
      const auto first = static_cast<std::size_t>(begin[c]), last = static_cast<std::size_t>(begin[c + 1]);
      if (last > first) body(first + c, last - first);
    }
  }
};

}  // namespace airlight
