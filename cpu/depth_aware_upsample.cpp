#include "cpu/kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/depth_aware_upsample.cpp"
#include <hwy/foreach_target.h>

#include "cpu/sample_window.h"
#include "cpu/simd.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

namespace {

// A vector of pixels among the samples around them.
struct Between {
  const SampleWindow& window;
  int column, row;  // of the first pixel in the tile; of the samples above
  Real u;
  float v;
  bool has_above, has_below;  // there are samples above and below the four
};

// One channel of the four samples, their bends and what these may be off by.
struct Channel {
  Real a, b, c, d;
  Real above, below, left, right;
  Real error;

  HWY_INLINE Channel(const Between& p, int plane) {
    const auto row = [&](int y) { return p.window.row(plane, p.row + y); };
    const SampleWindow::Row over = row(-1), upper = row(0), lower = row(1), under = row(2);
    const auto at = [&](const float* floats) HWY_ATTR { return load(floats + p.column); };
    a = at(upper.left), b = at(upper.right), c = at(lower.left), d = at(lower.right);
    above = at(upper.bend), below = at(lower.bend);
    const Real yes = 1.0, no = 0.0;
    const Mask has_above = (p.has_above ? yes : no) > 0.5, has_below = (p.has_below ? yes : no) > 0.5;
    left = bend_between(at(over.left), a, c, at(under.left), has_above, has_below);
    right = bend_between(at(over.right), b, d, at(under.right), has_above, has_below);
    const Real left_size = bend_size(at(over.left), a, c, at(under.left), has_above, has_below);
    const Real right_size = bend_size(at(over.right), b, d, at(under.right), has_above, has_below);
    error = upsampling_error(at(upper.size), at(lower.size), left_size, right_size, p.u, p.v);
  }
};

// How the pixels are served; which of these ways is the first that may be taken.
struct Serving {
  Mask smooth, served;
  Real weights[4];  // where it is not smooth; their sum is 1

  HWY_INLINE Real of(const Channel& s, const Between& p) const {
    const Real bent = upsampled(s.a, s.b, s.c, s.d, s.above, s.below, s.left, s.right, p.u, p.v);
    const Real mean = weighted_mean(s.a, s.b, s.c, s.d, weights[0], weights[1], weights[2], weights[3]);
    return select(served, select(smooth, bent, mean), 0.0);
  }
};

HWY_INLINE Real largest(Real a, Real b, Real c, Real d) { return max(max(a, b), max(c, d)); }
HWY_INLINE Real least(Real a, Real b, Real c, Real d) { return min(min(a, b), min(c, d)); }

// What is known of the samples' values: the largest, and the error of each way.
struct Errors {
  Real most, most_fitting, smooth, spread, spread_fitting;

  HWY_INLINE Errors() { most = most_fitting = smooth = spread = spread_fitting = 0.0; }
  HWY_INLINE void add(const Channel& s, const Real* fit) {
    smooth = max(smooth, s.error);
    const Real high = largest(s.a, s.b, s.c, s.d);
    most = max(most, high);
    spread = max(spread, high - least(s.a, s.b, s.c, s.d));
    const Real values[4] = {s.a, s.b, s.c, s.d};
    Real high_fitting = 0.0, low_fitting = 1e30;
    for (int k = 0; k < 4; ++k) {
      high_fitting = select(fit[k] > 0.0, max(high_fitting, values[k]), high_fitting);
      low_fitting = select(fit[k] > 0.0, min(low_fitting, values[k]), low_fitting);
    }
    most_fitting = max(most_fitting, high_fitting);
    spread_fitting = max(spread_fitting, high_fitting - low_fitting);
  }
};

// channels: three of airlight and the transmittance.
HWY_INLINE Serving serving(const DepthAwareUpsample& a, const Between& p, Real distance, const Channel* channels) {
  const float tolerance = a.tolerance;
  const Real inverse = 1.0 / distance;
  const SampleWindow::Row upper = p.window.row(0, p.row), lower = p.window.row(0, p.row + 1);
  const Real end[4] = {load(upper.left + p.column), load(upper.right + p.column), load(lower.left + p.column),
                       load(lower.right + p.column)};
  const Real u = min(p.u, 1.0), v = min(Real(p.v), 1.0);
  const Real bilinear[4] = {(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v};
  Real fit[4], fitting = 0.0;
  for (int k = 0; k < 4; ++k) {
    fit[k] = bilinear[k] * depth_fit(inverse, end[k], tolerance);
    fitting += fit[k];
  }
  Errors light, through;
  for (int c = 0; c < 3; ++c) light.add(channels[c], fit);
  through.add(channels[3], fit);
  through.most = max(through.most, least_transmittance());
  through.most_fitting = max(through.most_fitting, least_transmittance());

  const Real flat = between(between(end[0], end[1], p.u), between(end[2], end[3], p.u), p.v);
  const Real most = light.most * tolerance, most_through = through.most * tolerance;
  Serving s;
  s.smooth = (abs(flat - inverse) <= inverse * tolerance) && (light.smooth <= most) && (through.smooth <= most_through);
  const Mask within = (inverse >= least(end[0], end[1], end[2], end[3]) * (1.0 - tolerance)) &&
                      (inverse <= largest(end[0], end[1], end[2], end[3]) * (1.0 + tolerance)) &&
                      (light.spread + light.smooth <= most) && (through.spread + through.smooth <= most_through);
  const Mask fits = (fitting >= least_fit()) && (light.spread_fitting + light.smooth <= light.most_fitting * tolerance) &&
                    (through.spread_fitting + through.smooth <= through.most_fitting * tolerance);
  s.served = s.smooth || within || fits;
  const Real whole = 1.0 / max(fitting, 1e-6);
  for (int k = 0; k < 4; ++k) s.weights[k] = select(within, bilinear[k], fit[k] * whole);
  return s;
}

}  // namespace

static void depth_aware_upsample(const DepthAwareUpsample& a, const TileView& view, const SampleWindow& window) {
  const float step = 1 / static_cast<float>(a.stride);
  const int last_column = std::max(window.extent.width - 2, 0), last_row = std::max(window.extent.height - 2, 0);
  const int layers = a.per_light ? a.per_light.layers : 0;
  const float* distance = view.plane(a.distance);
  for (int i = 0; i < tile_pixels; i += lanes) {
    const int y = view.tile.y + i / tile_side, row = std::min(y / a.stride, last_row);
    const Real x = (first_lanes() + static_cast<float>(view.tile.x + i % tile_side)) * step;
    const Real u = x - min(floor(x), static_cast<float>(last_column));
    const float v = static_cast<float>(y) * step - static_cast<float>(row);
    const Between p{window, i % tile_side, row, u, v, row > 0, row < last_row};
    const Channel channels[4] = {Channel(p, 1), Channel(p, 2), Channel(p, 3), Channel(p, SampleWindow::transmittance_plane)};
    const Serving s = serving(a, p, load(distance + i), channels);
    store(select(s.served, 0.0, load(distance + i)), view.plane(a.remaining) + i);
    for (int c = 0; c < 3; ++c) store(s.of(channels[c], p), view.plane(a.airlight, c) + i);
    store(min(s.of(channels[3], p), 1.0), view.plane(a.transmittance) + i);
    for (int k = 0; k < layers; ++k) {
      for (int c = 0; c < 3; ++c)
        store(s.of(Channel(p, SampleWindow::first_light_plane + 3 * k + c), p), view.plane(a.per_light, c, k) + i);
    }
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(depth_aware_upsample);

void run_tile(const DepthAwareUpsample& a, const TileView& view, Simd simd) {
  static_assert(tile_side % 4 == 0);
  entry(HWY_DISPATCH_TABLE(depth_aware_upsample), simd)(a, view, SampleWindow(a, view));
}

}  // namespace airlight
#endif
