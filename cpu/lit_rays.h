// The parts of a vector of rays that each light reaches. Included after cpu/simd.h, anew for every target.
#if defined(AIRLIGHT_CPU_LIT_RAYS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AIRLIGHT_CPU_LIT_RAYS_H
#undef AIRLIGHT_CPU_LIT_RAYS_H
#else
#define AIRLIGHT_CPU_LIT_RAYS_H
#endif

#include <algorithm>
#include <span>

#include "cpu/shadow_parts.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

// Parts are laid out side by side: the k-th of every ray is a vector of begins and one of ends. A ray that has fewer gets empty
// ones beyond its end.
struct LitRays {
  std::span<const LitParts> lights;
  LitScratch& scratch;

  HWY_INLINE LitRays(std::span<const LitParts> parts, LitScratch& memory) : lights(parts), scratch(memory) {}
  explicit operator bool() const { return !lights.empty(); }

  // For pixels i .. i + lanes - 1 of the tile.
  HWY_INLINE void begin(int i) {
    constexpr std::ptrdiff_t floats_a_part = 2 * lanes;
    constexpr float beyond = 1e30F;
    scratch.first.assign(lights.size() + 1, 0);
    std::uint32_t count = 0;
    for (std::size_t k = 0; k < lights.size(); ++k) {
      scratch.first[k] = count;
      count += most_parts(lights[k], i);
    }
    scratch.first[lights.size()] = count;
    scratch.at.assign(scratch.first.begin(), scratch.first.end() - 1);
    float* const floats = scratch.floats.resize(std::max<std::size_t>(count, 1) * floats_a_part);
    for (std::size_t k = 0; k < lights.size(); ++k) {
      const LitParts& l = lights[k];
      float* to = floats + scratch.first[k] * floats_a_part;
      for (std::uint32_t n = 0; n < scratch.first[k + 1] - scratch.first[k]; ++n, to += floats_a_part) {
        if (l.rays == LitParts::Rays::lit) {  // all of every ray
          store(0.0, to);
          store(beyond, to + lanes);
          continue;
        }
        const std::uint32_t* first = l.first_part.data() + i;
        for (int lane = 0; lane < lanes; ++lane) {
          const std::uint32_t part = first[lane] + n;
          const bool there = part < first[lane + 1];
          to[lane] = there ? l.from[part] : beyond;
          to[lanes + lane] = there ? l.to[part] : beyond;
        }
      }
    }
  }

  // Calls visit(begin, end) for the parts of light k within [from, to], in order, nothing where end <= begin. From one call to
  // the next for the same light and rays `from` must not fall. A ray's parts do not depend on what lies beside it, though it may
  // be handed empty ones between.
  template <class Visit>
  HWY_INLINE void each(std::size_t k, Real from, Real to, Visit&& visit) {
    const std::uint32_t last = scratch.first[k + 1];
    const auto floats_of = [&](std::uint32_t n) { return scratch.floats.data() + static_cast<std::ptrdiff_t>(n) * 2 * lanes; };
    std::uint32_t& n = scratch.at[k];
    while (n < last && !any_lane(load(floats_of(n) + lanes) > from)) ++n;
    for (std::uint32_t part = n; part < last; ++part) {
      const Real begin = load(floats_of(part)), end = load(floats_of(part) + lanes);
      if (!any_lane(begin < to)) break;
      const Real a = min(max(begin, from), to), b = min(max(end, from), to);
      if (any_lane(a < b)) visit(a, b);
    }
  }

 private:
  HWY_INLINE static std::uint32_t most_parts(const LitParts& l, int i) {
    if (l.rays != LitParts::Rays::mixed) return l.rays == LitParts::Rays::lit ? 1 : 0;
    std::uint32_t most = 0;
    const std::uint32_t* first = l.first_part.data() + i;
    for (int lane = 0; lane < lanes; ++lane) most = std::max(most, first[lane + 1] - first[lane]);
    return most;
  }
};

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
