#include "cpu/shadow_parts.h"

#include <algorithm>

namespace airlight {

void by_pixel(Crossings& c) {
  c.begin.assign(tile_pixels + 1, 0);
  for (std::size_t i = 0; i < c.count; ++i) ++c.begin[c.where[i] % tile_pixels + 1];
  for (std::size_t p = 1; p < c.begin.size(); ++p) c.begin[p] += c.begin[p - 1];
  if (c.of_pixel.size() < c.count) c.of_pixel.resize(c.k.size());
  for (std::size_t i = 0; i < c.count; ++i) {
    const std::int32_t change =
        static_cast<std::int32_t>(c.where[i] / tile_pixels) - static_cast<std::int32_t>(Crossings::change_offset);
    c.of_pixel[c.begin[c.where[i] % tile_pixels]++] = {c.k[i], change};
  }
  for (std::size_t p = tile_pixels; p > 0; --p) c.begin[p] = c.begin[p - 1];
  c.begin[0] = 0;
}

void sort_by_distance(Crossings& c) {
  // Of planes crossed at the same place the order does not matter: the part between them is empty.
  const auto nearer = [](const Crossings::One& p, const Crossings::One& q) {
    return p.k > q.k || (!(p.k < q.k) && p.change < q.change);
  };
  for (std::size_t p = 0; p < tile_pixels; ++p) {
    Crossings::One* const first = c.of_pixel.data() + c.begin[p];
    Crossings::One* const last = c.of_pixel.data() + c.begin[p + 1];
    if (last - first > 24) {
      std::sort(first, last, nearer);
      continue;
    }
    for (Crossings::One* i = first; i < last; ++i) {
      const Crossings::One one = *i;
      Crossings::One* hole = i;
      for (; hole > first && nearer(one, hole[-1]); --hole) *hole = hole[-1];
      *hole = one;
    }
  }
}

// A ray is lit where no triangle stands between it and the light; a count below 0 can only
// come from rounding, at a pixel whose ray grazes an edge.
void find_parts(Crossings& c, std::int64_t covering, float* lit) {
  c.from.clear();
  c.to.clear();
  c.first_part.resize(tile_pixels + 1);
  const float* length = c.rays.data();
  const float* slant = length + tile_pixels;
  for (std::size_t p = 0; p < tile_pixels; ++p) {
    c.first_part[p] = static_cast<std::uint32_t>(c.from.size());
    std::int64_t count = covering;
    float at = 0;         // where the ray has been followed to
    float lit_from = -1;  // of the lit part that is open; negative: none
    // Parts of no length count for nothing: planes crossed at the same place may come in any order.
    const auto advance = [&](float next) {
      if (at < next) {
        if (count <= 0 && lit_from < 0) lit_from = at;
        if (count > 0 && lit_from >= 0) {
          c.from.push_back(lit_from);
          c.to.push_back(at);
          lit_from = -1;
        }
      }
      at = next;
    };
    for (std::size_t i = c.begin[p]; i < c.begin[p + 1]; ++i) {
      advance(std::min(slant[p] / c.of_pixel[i].k, length[p]));
      count += c.of_pixel[i].change;
    }
    advance(length[p]);
    if (lit_from >= 0) {
      c.from.push_back(lit_from);
      c.to.push_back(at);
    }
    if (lit) lit[p] = count <= 0 ? 1.0F : 0.0F;
  }
  c.first_part[tile_pixels] = static_cast<std::uint32_t>(c.from.size());
}

void find_published_parts(Crossings& c, std::int64_t covering, float* lit) {
  c.from.clear();
  c.to.clear();
  c.first_part.resize(tile_pixels + 1);
  const float* length = c.rays.data();
  const float* slant = length + tile_pixels;
  for (std::size_t p = 0; p < tile_pixels; ++p) {
    c.first_part[p] = static_cast<std::uint32_t>(c.from.size());
    const Crossings::One* const first = c.of_pixel.data() + c.begin[p];
    const Crossings::One* const last = c.of_pixel.data() + c.begin[p + 1];
    // Steps 2 and 3: the surface.
    std::int64_t stencil = covering;
    for (const Crossings::One* i = first; i < last; ++i) stencil += i->change;
    if (lit) lit[p] = stencil <= 0 ? 1.0F : 0.0F;
    if (stencil <= 0) {
      c.from.push_back(0);
      c.to.push_back(length[p]);
    }
    // Step 5. `change` is that away from the camera, and here a ray is followed toward it.
    for (const Crossings::One* i = first; i < last; ++i) {
      const bool was_lit = stencil <= 0;
      stencil -= i->change;
      if (was_lit == (stencil <= 0)) continue;
      const float at = std::min(slant[p] / i->k, length[p]);
      c.from.push_back(was_lit ? at : 0);
      c.to.push_back(was_lit ? 0 : at);
    }
  }
  c.first_part[tile_pixels] = static_cast<std::uint32_t>(c.from.size());
}

}  // namespace airlight
