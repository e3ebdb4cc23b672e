#include <algorithm>
#include <cstdint>
#include <vector>

#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/visibility_network.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/medium.h"

#ifndef AIRLIGHT_CPU_VISIBILITY_NETWORK
#define AIRLIGHT_CPU_VISIBILITY_NETWORK
namespace airlight {

namespace {

constexpr int padding = 16;  // the most lanes
// Places of particles in their pixel are summed up in eighths of a lattice unit, so that sums fit 32 bits on GL, too.
constexpr int sum_unit = lattice_length / 8;

// A Gaussian in the frame of a bundle of lines [m].
struct AcrossLine {
  float across, down, along, radius, extinction, reach;
};

// A list of particles on a line, and where what is found out of it goes.
struct LineList {
  float across, down;  // [m] of the line
  glm::vec3 axes[3];   // across, down, along
  const std::vector<AcrossLine>* gaussians;
  int count;      // of particles; links are one more
  float* along;   // [m] of the particles, with padding
  float* erfs;    // scratch: count + 2, with padding
  float* depths;  // scratch: count + 1, with padding
  float *depth, *lost, *given, *kept;
};

}  // namespace

}  // namespace airlight
#endif

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

static void list_links(const VisibilityNetwork& a, const float* voxels, const LineList& list) {
  const int n = list.count, links = n + 1;
  for (int k = 0; k < links; k += lanes) store(0.0, list.depths + k);
  for (const AcrossLine& g : *list.gaussians) {
    const float x = g.across - list.across, y = g.down - list.down;
    const Real h = sqrt(fma(Real(x), x, Real(y) * y));
    if (!any_lane(h < g.reach)) continue;
    const float inverse = 1 / g.radius;
    const Real lateral = gaussian_lateral(inverse, h) * gaussian_whole(g.extinction, g.radius);
    list.erfs[0] = -1;
    for (int k = 0; k < n; k += lanes) store(erf_((load(list.along + k) - g.along) * inverse), list.erfs + 1 + k);
    list.erfs[n + 1] = 1;
    for (int k = 0; k < links; k += lanes) {
      const Real between = gaussian_between(lateral, load(list.erfs + k), load(list.erfs + k + 1));
      store(load(list.depths + k) + between, list.depths + k);
    }
  }
  if (a.grid) {
    const GridLookup grid{&a.grid, voxels, voxels + bricks_at(a.grid)};
    const glm::vec3 at = list.axes[0] * list.across + list.axes[1] * list.down;
    const Real3 from = real3(at), way = real3(list.axes[2]);
    const float far = 2 * a.unit * lattice_length;  // outside the medium
    const Real3 start = along(from, way, -far);
    const Stretch inside = grid.stretch(start, way, 2 * far);
    const Real begin = inside.begin - far, end = max(inside.end - far, begin);
    const Real share = 1 / static_cast<float>(a.samples);
    for (int k = 0; k < links; k += lanes) {
      const Real number = first_lanes() + static_cast<float>(k);
      const Real before = k == 0 ? select(number < 0.5, begin, load(list.along + k - 1)) : load(list.along + k - 1);
      const Real after = select(number < static_cast<float>(n) - 0.5, load(list.along + k), end);
      const Real length = max(after - before, 0.0);
      Real met = 0.0;
      for (int i = 0; i < a.samples; ++i) {
        const Real t = fma(length, (static_cast<float>(i) + 0.5F) * share, before);
        met += grid.extinction_at(along(from, way, t));
      }
      store(fma(met * share, length, load(list.depths + k)), list.depths + k);
    }
  }
  for (int k = 0; k < links; k += lanes) {
    const Real number = first_lanes() + static_cast<float>(k);
    const Real inner = select((number > 0.5) && (number < static_cast<float>(n) - 0.5),
                              max(load(list.along + k) - load(list.along + k - 1), 0.0), 0.0);
    const Real depth = load(list.depths + k);
    Real lost, given, kept;
    link_shares(depth, fma(inner, a.extinction, depth), lost, given, kept);
    HWY_ALIGN float values[3][16];
    store(lost, values[0]);
    store(given, values[1]);
    store(kept, values[2]);
    const int here = std::min(lanes, links - k);
    std::copy_n(list.depths + k, here, list.depth + k);
    std::copy_n(values[0], here, list.lost + k);
    std::copy_n(values[1], here, list.given + k);
    std::copy_n(values[2], here, list.kept + k);
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(list_links);

namespace {

std::int32_t dot_of(const std::int32_t* a, const std::int32_t (&p)[3]) { return a[0] * p[0] + a[1] * p[1] + a[2] * p[2]; }

glm::vec3 axis_of(const std::int32_t* a) {
  constexpr float scale = 1.0F / lattice_length;
  return {static_cast<float>(a[0]) * scale, static_cast<float>(a[1]) * scale, static_cast<float>(a[2]) * scale};
}

float dot_of(const glm::vec3& a, const glm::vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

struct Worker {
  // In a pixel by place along the line, then by number.
  struct Place {
    std::int32_t along, particle;
    bool operator<(const Place& b) const { return along != b.along ? along < b.along : particle < b.particle; }
  };
  std::vector<std::size_t> pixels;      // of each particle
  std::vector<std::int32_t> within[2];  // of each pixel, summed over its particles: where in it they are, across and down
  std::vector<std::size_t> ends;        // of each pixel's places
  std::vector<Place> places;
  std::vector<AcrossLine> gaussians;
  std::vector<float> along, erfs, depths;
  std::size_t empty = 0;  // lists
};

void line_links(const VisibilityNetwork& a, const float* particles, const std::int32_t* lines, const float* voxels, std::size_t l,
                Worker& w, float* out, Simd simd) {
  const NetworkShape shape = a.shape();
  const std::int32_t* line = lines + line_fields * l;
  const std::int32_t columns = line[line_pixels], *across = lines + shape.edges(l), *down = across + columns + 1;
  const float unit = a.unit / lattice_length;
  w.places.resize(shape.particles);
  w.pixels.resize(shape.particles);
  w.ends.assign(shape.slots + 1, 0);
  for (std::vector<std::int32_t>& sums : w.within) sums.assign(shape.slots, 0);
  const auto place_of = [&](std::size_t v, std::int32_t(&p)[3]) {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = static_cast<std::int32_t>(particles[axis * shape.particles + v]);
  };
  for (std::size_t v = 0; v < shape.particles; ++v) {
    std::int32_t p[3];
    place_of(v, p);
    const std::int32_t x = dot_of(line + line_across, p), y = dot_of(line + line_down, p);
    const auto column = static_cast<std::size_t>(std::upper_bound(across, across + columns, x) - across - 1),
               row = static_cast<std::size_t>(std::upper_bound(down, down + line[line_pixels + 1], y) - down - 1);
    w.pixels[v] = column + static_cast<std::size_t>(columns) * row;
    w.within[0][w.pixels[v]] += (x - across[column]) / sum_unit;
    w.within[1][w.pixels[v]] += (y - down[row]) / sum_unit;
    ++w.ends[w.pixels[v] + 1];
  }
  for (std::size_t c = 0; c < shape.slots; ++c) w.ends[c + 1] += w.ends[c];  // where pixels begin, for now
  for (std::size_t v = 0; v < shape.particles; ++v) {
    std::int32_t p[3];
    place_of(v, p);
    w.places[w.ends[w.pixels[v]]++] = {dot_of(line + line_direction, p), static_cast<std::int32_t>(v)};
  }

  LineList list{};
  for (int i = 0; i < 3; ++i) list.axes[i] = axis_of(line + (i == 0 ? line_across : i == 1 ? line_down : line_direction));
  w.gaussians.clear();
  for (const GaussianDensity& g : a.gaussians) {
    w.gaussians.push_back({dot_of(list.axes[0], g.center), dot_of(list.axes[1], g.center), dot_of(list.axes[2], g.center),
                           g.radius, g.extinction, g.reach});
  }
  list.gaussians = &w.gaussians;
  float* begin = out + l * (shape.slots + 1);
  float* planes[link_planes];
  for (int k = 0; k < link_planes; ++k) planes[k] = out + shape.record(l, k);
  std::size_t first = 0;
  for (std::size_t c = 0; c < shape.slots; ++c) {
    begin[c] = static_cast<float>(first);
    const std::size_t last = w.ends[c];
    std::sort(w.places.begin() + static_cast<std::ptrdiff_t>(first), w.places.begin() + static_cast<std::ptrdiff_t>(last));
    const std::size_t n = last - first, at = first + c;
    if (n > 0) {
      w.along.assign(n + 2 * padding, 0.0F);
      w.erfs.assign(n + 2 + 2 * padding, 0.0F);
      w.depths.assign(n + 1 + padding, 0.0F);
      const auto mean = [&](int which, std::int32_t edge) {
        const float within = (static_cast<float>(w.within[which][c]) / static_cast<float>(n) + 0.5F) * sum_unit;
        return (static_cast<float>(edge) + within) * unit;
      };
      list.across = mean(0, across[c % static_cast<std::size_t>(columns)]);
      list.down = mean(1, down[c / static_cast<std::size_t>(columns)]);
      list.count = static_cast<int>(n);
      list.along = w.along.data() + padding;
      list.erfs = w.erfs.data();
      list.depths = w.depths.data();
      list.depth = planes[link_depth] + at;
      list.lost = planes[link_lost] + at;
      list.given = planes[link_given] + at;
      list.kept = planes[link_kept] + at;
      for (std::size_t k = 0; k < n; ++k) {
        planes[link_particle][at + k] = static_cast<float>(w.places[first + k].particle);
        list.along[k] = static_cast<float>(w.places[first + k].along) * unit;
      }
      entry(HWY_DISPATCH_TABLE(list_links), simd)(a, voxels, list);
    }
    if (n == 0) {
      ++w.empty;
      for (int k = link_depth; k < link_planes; ++k) planes[k][at] = 0;
    }
    planes[link_particle][at + n] = -1;
    first = last;
  }
  begin[shape.slots] = static_cast<float>(first);
}

}  // namespace

void run_volume(const VisibilityNetwork& a, const BufferView& view, Workers& workers, Simd simd) {
  std::vector<Worker> scratch(static_cast<std::size_t>(workers.threads()));
  const std::int32_t* lines = view.integers(a.lines);
  workers.each(a.line_count, [&](int l, int worker) {
    line_links(a, view.floats(a.particles), lines, view.floats(a.voxels), static_cast<std::size_t>(l),
               scratch[static_cast<std::size_t>(worker)], view.made(a.links), simd);
  });
  view.counts.parts = a.shape().slots * a.shape().lines;
  for (const Worker& w : scratch) view.counts.skipped_parts += w.empty;
}

}  // namespace airlight
#endif
