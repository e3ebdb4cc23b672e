#include "cpu/particle_splats.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/plan/gaussian_bins.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/particle_splats.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/network.h"

#ifndef AIRLIGHT_CPU_PARTICLE_SPLATS
#define AIRLIGHT_CPU_PARTICLE_SPLATS
namespace airlight {
namespace {

constexpr int batch = 16;  // splats whose directions are looked at together: the most lanes

// A batch of them: where each lies, and what it sends, a channel after another. `first_value` of each: 4 times its particle.
struct SplatBatch {
  float x[batch], y[batch], z[batch], first_value[batch];
  float radiance[3][batch];
};

}  // namespace
}  // namespace airlight
#endif

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

// What they send toward the camera, between the directions of the network.
static void splat_radiance(const ParticleSplats& a, const std::int32_t* lines, const float* sources, SplatBatch& b) {
  const Real inverse_reach = a.inverse_reach();
  const std::ptrdiff_t row = 4 * static_cast<std::ptrdiff_t>(a.particle_count);
  for (int k = 0; k < batch; k += lanes) {
    const Real3 center{load(b.x + k), load(b.y + k), load(b.z + k)};
    const Real scale = -1.0 / sqrt(max(dot(center, center), 1e-37));
    const Real3 to{center.x * scale, center.y * scale, center.z * scale};
    const Real value = load(b.first_value + k);
    Real sum[3] = {0.0, 0.0, 0.0}, weights = 0.0;
    const auto add = [&](Real weight, const float* source) HWY_ATTR {
      if (!any_lane(weight > 0.0)) return;
      for (int c = 0; c < 3; ++c) sum[c] = fma(weight, fetch(source + c, value), sum[c]);
      weights += weight;
    };
    for (int l = 0; l < a.line_count; ++l) {
      const Real mu = dot(line_direction_of(lines + static_cast<std::ptrdiff_t>(line_fields) * l), to);
      add(direction_weight(mu, inverse_reach), sources + row * 2 * l);
      add(direction_weight(-mu, inverse_reach), sources + row * (2 * l + 1));
    }
    const Real share = 1.0 / max(weights, 1e-30);
    for (int c = 0; c < 3; ++c) store(sum[c] * share, b.radiance[c] + k);
  }
}

// One square of the tile, its upper left pixel at (x, y) in the tile.
static void particle_splats(const ParticleSplats& a, const TileView& view, std::span<const std::int32_t> list, const float* seen,
                            int x, int y) {
  const Real least_seen = a.least_seen;
  const bool fog = a.extinction > 0, all_depth = static_cast<bool>(a.optical_depth);
  for (int row = y; row < y + bin_side; ++row) {
    for (int column = x; column < x + bin_side; column += lanes) {
      const int i = row * tile_side + column;
      const Real length = ray_length(load(view.plane(a.distance) + i), a.sky_distance);
      const Real3 d = pixel_rays(a.view, view.tile, i);
      const Real end = min(length, 1e15);
      Real sum[3] = {0.0, 0.0, 0.0}, depth = 0.0, left = 1.0;
      for (const std::int32_t number : list) {
        const float* one = seen + static_cast<std::ptrdiff_t>(seen_fields) * number;
        Real foot;
        const Real tau = splat_depth(d.x, d.y, d.z, one[seen_center], one[seen_center + 1], one[seen_center + 2],
                                     one[seen_inverse_support], one[seen_peak], end, foot);
        if (!any_lane(tau > 0.0)) continue;
        depth += tau;
        const Mask open = left > least_seen;
        Real hidden = select(open, left * splat_opacity(tau), 0.0);
        left -= hidden;
        if (fog) hidden = hidden * transmittance(min(max(foot, 0.0), end) * a.extinction);
        for (int c = 0; c < 3; ++c) sum[c] = fma(hidden, one[seen_radiance + c], sum[c]);
        if (!all_depth && !any_lane(left > least_seen)) break;
      }
      const Real of_fog = optical_depth(length, a.extinction);
      for (int c = 0; c < 3; ++c) {
        const Real behind = a.scattered ? load(view.plane(a.scattered, c) + i) : Real(0.0);
        store(sum[c] + behind, view.plane(a.airlight, c) + i);
      }
      store(left * transmittance(of_fog), view.plane(a.transmittance) + i);
      if (all_depth) store(min(depth + of_fog, 1e30), view.plane(a.optical_depth) + i);
    }
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(splat_radiance);
HWY_EXPORT(particle_splats);

void see_splats(const ParticleSplats& a, std::span<const float> splats, std::span<const float> particle_sources,
                std::span<const std::int32_t> lines, Workers& workers, Simd simd, std::vector<float>& seen) {
  const auto n = static_cast<std::size_t>(a.particle_count);
  seen.resize(seen_fields * n);
  workers.each(static_cast<int>((n + batch - 1) / batch), [&](int number, int) {
    const std::size_t first = batch * static_cast<std::size_t>(number), count = std::min<std::size_t>(batch, n - first);
    SplatBatch b{};
    const auto splat = [&](std::size_t k) { return splats.data() + splat_fields * (first + std::min(k, count - 1)); };
    for (std::size_t k = 0; k < batch; ++k) {
      const float* one = splat(k);
      b.x[k] = one[splat_center], b.y[k] = one[splat_center + 1], b.z[k] = one[splat_center + 2];
      b.first_value[k] = 4 * one[splat_particle];
      for (std::size_t c = 0; c < 3; ++c)
        b.radiance[c][k] = particle_sources[4 * static_cast<std::size_t>(one[splat_particle]) + c];
    }
    if (a.directions() > 1) entry(HWY_DISPATCH_TABLE(splat_radiance), simd)(a, lines.data(), particle_sources.data(), b);
    for (std::size_t k = 0; k < count; ++k) {
      float* to = seen.data() + seen_fields * (first + k);
      std::copy_n(splat(k) + splat_center, seen_radiance, to);
      for (std::size_t c = 0; c < 3; ++c) to[seen_radiance + c] = b.radiance[c][k] + a.ambient[static_cast<int>(c)];
    }
  });
}

namespace {

// The rays of a square of the screen, its upper left pixel at (x, y), all lie about its middle one.
struct SquareOfRays {
  glm::dvec3 middle;
  double apart = 0;  // [rad] at most

  SquareOfRays(const View& view, int x, int y) {
    const double w = view.extent.width, h = view.extent.height, t = static_cast<double>(view.tan_half_fov);
    const auto ray = [&](double i, double j) {
      const double across = (2 * (i + 0.5 + static_cast<double>(view.offset.x)) / w - 1) * t * w / h;
      const double up = (1 - 2 * (j + 0.5 + static_cast<double>(view.offset.y)) / h) * t;
      return glm::normalize(across * glm::dvec3(view.right) + up * glm::dvec3(view.up) + glm::dvec3(view.forward));
    };
    constexpr double last = bin_side - 1;
    middle = ray(x + 0.5 * last, y + 0.5 * last);
    // Up to a right angle an angle is no more than 1.12 times its chord.
    for (const double i : {0.0, last}) {
      for (const double j : {0.0, last}) apart = std::max(apart, 1.12 * glm::length(ray(x + i, y + j) - middle));
    }
  }

  // Whether one of them may meet a splat; rays in single precision as well.
  bool meets(const float* one) const {
    const glm::dvec3 c(one[seen_center], one[seen_center + 1], one[seen_center + 2]);
    const double squared = glm::dot(c, c), foot = glm::dot(c, middle);
    const double most = 1.0001 / static_cast<double>(one[seen_inverse_support]) + std::sqrt(squared) * (apart + 1e-6);
    return squared - foot * foot <= most * most;
  }
};

}  // namespace

void run_tile(const ParticleSplats& a, const TileView& view, std::span<const float> seen, Simd simd) {
  static_assert(tile_side % bin_side == 0);
  static_assert(splat_inverse_support == static_cast<int>(seen_inverse_support) && splat_peak == static_cast<int>(seen_peak));
  const auto* bins = reinterpret_cast<const std::int32_t*>(view.floats(a.bins));
  std::vector<std::int32_t> met;
  for (int y = 0; y < tile_side; y += bin_side) {
    for (int x = 0; x < tile_side; x += bin_side) {
      if (view.tile.x + x >= a.view.extent.width || view.tile.y + y >= a.view.extent.height) continue;  // never read
      const int square = (view.tile.y + y) / bin_side * bin_columns(a.view.extent) + (view.tile.x + x) / bin_side;
      // Lists are of boxes about splats, whose corners are many.
      const SquareOfRays rays(a.view, view.tile.x + x, view.tile.y + y);
      met.clear();
      for (const std::int32_t number : std::span(bins + bins[square], bins + bins[square + 1])) {
        if (rays.meets(seen.data() + seen_fields * static_cast<std::size_t>(number))) met.push_back(number);
      }
      if (met.empty()) view.skip(view.in_image(x, y, bin_side));
      entry(HWY_DISPATCH_TABLE(particle_splats), simd)(a, view, met, seen.data(), x, y);
    }
  }
}

}  // namespace airlight
#endif
