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

// A vector of columns of pixels between two rows of samples. `stride` rows of pixels have that in common.
struct Columns {
  const SampleWindow& window;
  int first, row;  // column in the tile; of the samples above
  Real u;
  bool has_above, has_below;  // there are samples above and below the four

  HWY_INLINE Real at(const float* floats) const { return load(floats + first); }
};

HWY_INLINE Real largest(Real a, Real b, Real c, Real d) { return max(max(a, b), max(c, d)); }
HWY_INLINE Real least(Real a, Real b, Real c, Real d) { return min(min(a, b), min(c, d)); }

// One channel of the four samples, their bends, and the sizes of these.
struct Channel {
  Real a, b, c, d;
  Real above, below, left, right;
  Real above_size, below_size, left_size, right_size;

  HWY_INLINE Channel(const Columns& p, int plane) {
    const auto row = [&](int y) { return p.window.row(plane, p.row + y); };
    const SampleWindow::Row over = row(-1), upper = row(0), lower = row(1), under = row(2);
    a = p.at(upper.left), b = p.at(upper.right), c = p.at(lower.left), d = p.at(lower.right);
    above = p.at(upper.bend), below = p.at(lower.bend);
    above_size = p.at(upper.size), below_size = p.at(lower.size);
    const Real yes = 1.0, no = 0.0;
    const Mask has_above = (p.has_above ? yes : no) > 0.5, has_below = (p.has_below ? yes : no) > 0.5;
    const Real over_left = p.at(over.left), under_left = p.at(under.left);
    const Real over_right = p.at(over.right), under_right = p.at(under.right);
    left = bend_between(over_left, a, c, under_left, has_above, has_below);
    right = bend_between(over_right, b, d, under_right, has_above, has_below);
    left_size = bend_size(over_left, a, c, under_left, has_above, has_below);
    right_size = bend_size(over_right, b, d, under_right, has_above, has_below);
  }

  HWY_INLINE Real most() const { return largest(a, b, c, d); }
  HWY_INLINE Real error(Real u, float v) const { return upsampling_error(above_size, below_size, left_size, right_size, u, v); }
  HWY_INLINE Real smooth(Real u, float v) const { return upsampled(a, b, c, d, above, below, left, right, u, v); }
  HWY_INLINE Real mean(const Real* weights) const {
    return weighted_mean(a, b, c, d, weights[0], weights[1], weights[2], weights[3]);
  }
};

// What decides how pixels are served.
struct Samples {
  Channel light[3], through;
  Real end[4];  // 1/distance
  Real most_light, most_through;

  HWY_INLINE explicit Samples(const Columns& p)
      : light{Channel(p, 1), Channel(p, 2), Channel(p, 3)}, through(p, SampleWindow::transmittance_plane) {
    const SampleWindow::Row upper = p.window.row(0, p.row), lower = p.window.row(0, p.row + 1);
    end[0] = p.at(upper.left), end[1] = p.at(upper.right), end[2] = p.at(lower.left), end[3] = p.at(lower.right);
    most_light = max(max(max(Real(0.0), light[0].most()), light[1].most()), light[2].most());
    most_through = max(through.most(), least_transmittance());
  }
};

// How a row of pixels is served; which of these ways is the first that may be taken.
struct Serving {
  float v;
  bool all_smooth;
  Mask smooth, served;
  Real weights[4];  // where it is not smooth; their sum is 1

  HWY_INLINE Real of(const Channel& s, Real u) const {
    const Real bent = s.smooth(u, v);
    return all_smooth ? bent : select(served, select(smooth, bent, s.mean(weights)), 0.0);
  }
};

// Of channels, between the samples that fit: the largest and how far they lie apart.
struct Fitting {
  Real most, spread;

  HWY_INLINE Fitting() { most = spread = 0.0; }
  HWY_INLINE void add(const Channel& s, const Real* fit) {
    const Real values[4] = {s.a, s.b, s.c, s.d};
    Real high = 0.0, low = 1e30;
    for (int k = 0; k < 4; ++k) {
      high = select(fit[k] > 0.0, max(high, values[k]), high);
      low = select(fit[k] > 0.0, min(low, values[k]), low);
    }
    most = max(most, high);
    spread = max(spread, high - low);
  }
};

HWY_INLINE Serving serving(const Samples& samples, Real u, float v, Real distance, float tolerance) {
  const Channel *light = samples.light, &through = samples.through;
  const Real* end = samples.end;
  const Real inverse = 1.0 / distance;
  const Real flat = between(between(end[0], end[1], u), between(end[2], end[3], u), v);
  const Real light_error = max(max(max(Real(0.0), light[0].error(u, v)), light[1].error(u, v)), light[2].error(u, v));
  const Real through_error = max(Real(0.0), through.error(u, v));
  const Real most_light = samples.most_light * tolerance, most_through = samples.most_through * tolerance;
  Serving s;
  s.v = v;
  s.smooth = s.served =
      (abs(flat - inverse) <= inverse * tolerance) && (light_error <= most_light) && (through_error <= most_through);
  s.all_smooth = !any_lane(!s.smooth);
  if (s.all_smooth) return s;

  const Real x = min(u, 1.0), y = min(Real(v), 1.0);
  const Real bilinear[4] = {(1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y};
  Real fit[4], fitting = 0.0;
  for (int k = 0; k < 4; ++k) {
    fit[k] = bilinear[k] * depth_fit(inverse, end[k], tolerance);
    fitting += fit[k];
  }
  Fitting light_fitting, through_fitting;
  Real light_spread = 0.0;
  for (int c = 0; c < 3; ++c) {
    light_fitting.add(light[c], fit);
    light_spread = max(light_spread, light[c].most() - least(light[c].a, light[c].b, light[c].c, light[c].d));
  }
  through_fitting.add(through, fit);
  const Real through_spread = max(Real(0.0), through.most() - least(through.a, through.b, through.c, through.d));
  through_fitting.most = max(through_fitting.most, least_transmittance());

  const Mask within = (inverse >= least(end[0], end[1], end[2], end[3]) * (1.0 - tolerance)) &&
                      (inverse <= largest(end[0], end[1], end[2], end[3]) * (1.0 + tolerance)) &&
                      (light_spread + light_error <= most_light) && (through_spread + through_error <= most_through);
  const Mask fits = (fitting >= least_fit()) && (light_fitting.spread + light_error <= light_fitting.most * tolerance) &&
                    (through_fitting.spread + through_error <= through_fitting.most * tolerance);
  s.served = s.smooth || within || fits;
  const Real whole = 1.0 / max(fitting, 1e-6);
  for (int k = 0; k < 4; ++k) s.weights[k] = select(within, bilinear[k], fit[k] * whole);
  return s;
}

}  // namespace

static void depth_aware_upsample(const DepthAwareUpsample& a, const TileView& view, const SampleWindow& window) {
  constexpr int most_rows = 4;  // of pixels to one of samples
  const float step = 1 / static_cast<float>(a.stride);
  const int last_column = std::max(window.extent.width - 2, 0), last_row = std::max(window.extent.height - 2, 0);
  const int layers = a.per_light ? a.per_light.layers : 0;
  const float* distance = view.plane(a.distance);
  float *const remaining = view.plane(a.remaining), *const transmittance = view.plane(a.transmittance);
  for (int y = 0; y < tile_side; y += a.stride) {
    const int row = std::min((view.tile.y + y) / a.stride, last_row);
    for (int column = 0; column < tile_side; column += lanes) {
      const Real x = (first_lanes() + static_cast<float>(view.tile.x + column)) * step;
      const Real u = x - min(floor(x), static_cast<float>(last_column));
      const Columns p{window, column, row, u, row > 0, row < last_row};
      const Samples samples(p);
      Serving servings[most_rows];
      for (int k = 0; k < a.stride; ++k) {
        const int i = (y + k) * tile_side + column;
        const float v = static_cast<float>(view.tile.y + y + k) * step - static_cast<float>(row);
        const Serving s = servings[k] = serving(samples, u, v, load(distance + i), a.tolerance);
        store(s.all_smooth ? Real(0.0) : select(s.served, 0.0, load(distance + i)), remaining + i);
        for (int c = 0; c < 3; ++c) store(s.of(samples.light[c], u), view.plane(a.airlight, c) + i);
        store(min(s.of(samples.through, u), 1.0), transmittance + i);
      }
      for (int layer = 0; layer < layers; ++layer) {
        for (int c = 0; c < 3; ++c) {
          const Channel channel(p, SampleWindow::first_light_plane + 3 * layer + c);
          float* to = view.plane(a.per_light, c, layer);
          for (int k = 0; k < a.stride; ++k) store(servings[k].of(channel, u), to + (y + k) * tile_side + column);
        }
      }
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
