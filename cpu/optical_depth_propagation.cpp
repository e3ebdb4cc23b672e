#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "common/algorithms/voxel_table.h"
#include "cpu/halves.h"
#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/optical_depth_propagation.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/medium.h"

#ifndef AIRLIGHT_CPU_OPTICAL_DEPTH_PROPAGATION
#define AIRLIGHT_CPU_OPTICAL_DEPTH_PROPAGATION
namespace airlight {

namespace {

constexpr int most_lanes = 16;

// Rays of one row of a face.
struct RayRow {
  int face = 0, j = 0;
};

// A line of cells along x: T of a cell is sums + shares T of the one before it.
struct CellLine {
  const float* extinction;
  const float *nearer_y, *nearer_z;  // depths of the lines beside it that are nearer to the light; null: 0
  float x, y, z;                     // from the light to the first centre [m]; of a directional one the way that it shines
  float *sums, *shares;
};

}  // namespace

}  // namespace airlight
#endif

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

namespace {

// A light's rays through `lanes` nodes of a face: a place at distance t from the light (of a parallel one, from the first plane)
// is from + t d; planes are `rate` z apart.
struct LightRays {
  Real3 from, d;
  Real rate;

  HWY_INLINE LightRays(const OpticalDepthPropagation& a, RayRow row, Real column) {
    const DepthVolume& v = a.volume;
    const Real u = fma(column, 1 / v.scale.x, v.first.x), w = fma(Real(static_cast<float>(row.j)), 1 / v.scale.y, v.first.y);
    const glm::vec4* r = v.rows;
    if (v.kind == DepthVolume::Kind::parallel) {
      const Real x = u - r[0].w, y = w - r[1].w, z = -r[2].w;
      from = {fma(x, r[0].x, fma(y, r[1].x, z * r[2].x)), fma(x, r[0].y, fma(y, r[1].y, z * r[2].y)),
              fma(x, r[0].z, fma(y, r[1].z, z * r[2].z))};
      d = {r[2].x, r[2].y, r[2].z};
      rate = 1.0;
      return;
    }
    Real q[3] = {u, w, 1.0};
    if (v.kind == DepthVolume::Kind::cube) {
      const int axis = row.face / 2;
      q[axis] = row.face % 2 == 0 ? 1.0 : -1.0;
      q[(axis + 1) % 3] = u;
      q[(axis + 2) % 3] = w;
    }
    rate = sqrt(fma(u, u, fma(w, w, 1.0)));
    const Real scale = 1.0 / rate;
    for (Real& c : q) c *= scale;
    from = real3(a.light.vector);
    d = {fma(q[0], r[0].x, fma(q[1], r[1].x, q[2] * r[2].x)), fma(q[0], r[0].y, fma(q[1], r[1].y, q[2] * r[2].y)),
         fma(q[0], r[0].z, fma(q[1], r[1].z, q[2] * r[2].z))};
  }
};

}  // namespace

// Depths of one row of rays, sharpened along them: `line` has room for the nodes of a ray, a vector each.
// Returns how many ways of its rays through Gaussians it passed over.
static std::size_t ray_row(const OpticalDepthPropagation& a, const float* voxels, RayRow row, float* line, float* depths) {
  std::size_t passed = 0;
  const DepthVolume& v = a.volume;
  const int nx = static_cast<int>(v.nodes.x), ny = static_cast<int>(v.nodes.y), nz = static_cast<int>(v.nodes.z);
  const float step = 1 / v.scale.z;
  const bool cube = v.kind == DepthVolume::Kind::cube;
  GridLookup grid{&a.grid, voxels, voxels};
  if (a.grid) grid.bricks += bricks_at(a.grid);
  for (int i = 0; i < nx; i += lanes) {
    const LightRays rays(a, row, first_lanes() + static_cast<float>(i));
    const auto plane = [&](int k) HWY_ATTR {
      const Real n = static_cast<float>(k);
      return cube ? cube_plane_distance(n) * step : fma(n, step, v.first.z);
    };
    const auto distance = [&](int k) HWY_ATTR { return plane(k) * rays.rate; };
    for (int k = 0; k < nz; ++k) store(0.0, line + k * lanes);
    for (const GaussianDensity& g : a.gaussians) {
      const Real3 e = to_center(g, rays.from);
      Real foot, h;
      perpendicular(rays.d.x, rays.d.y, rays.d.z, e.x, e.y, e.z, 0.0, foot, h);
      const Real begin = foot - g.reach, end = foot + g.reach;
      const Mask meets = (h < g.reach) && (end > 0.0);
      if (!any_lane(meets)) {
        passed += static_cast<std::size_t>(std::min(lanes, nx - i));
        continue;
      }
      const Real inverse = 1 / g.radius;
      const Real lateral = gaussian_lateral(inverse, h) * gaussian_whole(g.extinction, g.radius);
      const Real before = erf_(-foot * inverse);
      const Real whole = gaussian_between(lateral, before, erf_(Real(g.reach) * inverse));
      for (int k = 0; k < nz; ++k) {
        const Real t = distance(k);
        const Mask here = meets && (t > begin);
        if (!any_lane(here)) continue;
        Real depth = whole;
        if (any_lane(t < end)) depth = select(t < end, gaussian_between(lateral, before, erf_((t - foot) * inverse)), whole);
        float* node = line + k * lanes;
        store(load(node) + select(here, depth, 0.0), node);
      }
    }
    if (a.grid) {
      Real sum = 0.0;
      const float part = 1 / static_cast<float>(a.samples);
      const Stretch inside = grid.stretch(rays.from, rays.d, 1e15);
      for (int k = 1; k < nz; ++k) {
        const Real from = distance(k - 1), size = distance(k) - from;
        const Mask meets = (from + size > inside.begin) && (from < inside.end);
        if (any_lane(meets)) {
          Real met = 0.0;
          for (int n = 0; n < a.samples; ++n) {
            const Real t = fma(size, (static_cast<float>(n) + 0.5F) * part, from);
            met += grid.extinction_at(along(rays.from, rays.d, t));
          }
          sum = fma(select(meets, met, 0.0), size * part, sum);
        }
        float* node = line + k * lanes;
        store(load(node) + sum, node);
      }
    }
    if (cube) {
      for (int k = 1; k < nz; ++k) store(load(line + k * lanes) / cube_plane_distance(static_cast<float>(k)), line + k * lanes);
      const Real first = load(line + lanes);
      store(depth_at_light(first, nz > 2 ? load(line + 2 * lanes) : first), line);
    }
    Real before = load(line);
    for (int k = 1; k < nz - 1; ++k) {
      float* node = line + k * lanes;
      const Real here = load(node);
      store(sharpened_depth(before, here, load(node + lanes)), node);
      before = here;
    }
    const int count = std::min(lanes, nx - i);
    for (int k = 0; k < nz; ++k) {
      const std::size_t at = static_cast<std::size_t>((row.face * nz + k) * ny + row.j) * static_cast<std::size_t>(nx);
      std::copy_n(line + k * lanes, count, depths + at + static_cast<std::size_t>(i));
    }
  }
  return passed;
}

// Sharpens a plane of nodes along its own two axes. `scratch`: two planes and a row, each row of nx + most_lanes.
static void sharpen_plane(int nx, int ny, float* plane, float* scratch) {
  const std::ptrdiff_t stride = nx + most_lanes;
  float *given = scratch, *along_x = scratch + stride * ny, *result = along_x + stride * ny;
  for (int j = 0; j < ny; ++j) {
    float *from = given + stride * j, *to = along_x + stride * j;
    std::copy_n(plane + static_cast<std::ptrdiff_t>(nx) * j, nx, from);
    for (int i = 1; i < nx - 1; i += lanes)
      store(sharpened_depth(load(from + i - 1), load(from + i), load(from + i + 1)), to + i);
    to[0] = from[0];
    to[nx - 1] = from[nx - 1];
  }
  for (int j = 0; j < ny; ++j) {
    const float* row = along_x + stride * j;
    const bool inside = j > 0 && j < ny - 1;
    for (int i = 0; inside && i < nx; i += lanes)
      store(sharpened_depth(load(row - stride + i), load(row + i), load(row + stride + i)), result + i);
    std::copy_n(inside ? result : row, nx, plane + static_cast<std::ptrdiff_t>(nx) * j);
  }
}

static void line_sums(const OpticalDepthPropagation& a, const CellLine& line, float cell) {
  const int nx = static_cast<int>(a.volume.nodes.x);
  const Real y = line.y, z = line.z, slab = a.light.directional ? Real(-1.0) : slab_share() * cell;
  for (int i = 0; i < nx; i += lanes) {
    const Real at = first_lanes() + static_cast<float>(i);
    const Real x = a.light.directional ? Real(line.x) : fma(at, cell, line.x);
    const Real length = sqrt(fma(x, x, fma(y, y, z * z)));
    const Real inverse = 1.0 / max(length, 1e-15);
    const Mask beside = abs(x) > slab;  // the cells between which the light is get nothing from each other
    const Real wx = select(beside, abs(x) * inverse, 0.0);
    const Real wy = select(abs(y) > slab, abs(y) * inverse, 0.0), wz = select(abs(z) > slab, abs(z) * inverse, 0.0);
    Real others = 0.0;
    if (line.nearer_z) others = wz * load(line.nearer_z + i);
    if (line.nearer_y) others = fma(wy, load(line.nearer_y + i), others);
    const Real weights = (wx + wy) + wz, extinction = load(line.extinction + i);
    const Mask own_cell = weights <= 0.0;
    const Real divisor = select(own_cell, 1.0, weights);
    store(select(own_cell, extinction * length, depth_beside(static_cast<int>(a.scheme), extinction * cell, others, divisor)),
          line.sums + i);
    store(wx / divisor, line.shares + i);
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(ray_row);
HWY_EXPORT(sharpen_plane);
HWY_EXPORT(line_sums);

namespace {

// In which layer of cells along an axis the light is: -1 before the first, n behind the last.
int layer_of(float light, float cell, int n) {
  return static_cast<int>(std::clamp(std::floor(light / cell), -1.0F, static_cast<float>(n)));
}

// Layers of cells, the light's first, then away from it.
template <class Body>
void outward(int light_at, int n, Body&& body) {
  for (int i = std::max(light_at, 0); i < n; ++i) body(i, i > light_at ? i - 1 : -1);
  for (int i = std::min(light_at, n) - 1; i >= 0; --i) body(i, i + 1 < n ? i + 1 : -1);
}

void sweep(const OpticalDepthPropagation& a, const float* voxels, float* depths, Simd simd) {
  const int nx = static_cast<int>(a.volume.nodes.x), ny = static_cast<int>(a.volume.nodes.y),
            nz = static_cast<int>(a.volume.nodes.z);
  const float cell = 1 / a.volume.rows[0].x;
  const glm::vec3 light = a.light.vector;
  int at[3];
  for (int axis = 0; axis < 3; ++axis) {
    const int n = static_cast<int>(a.volume.nodes[axis]);
    at[axis] = a.light.directional ? (light[axis] > 0 ? -1 : n) : layer_of(light[axis], cell, n);
  }
  const std::size_t stride = static_cast<std::size_t>(nx + most_lanes), plane = stride * static_cast<std::size_t>(ny);
  std::vector<float> here(plane), before(plane), sums(stride), shares(stride);
  const auto from_light = [&](int axis, int i) {
    return a.light.directional ? light[axis] : (static_cast<float>(i) + 0.5F) * cell - light[axis];
  };
  int last = -1;
  outward(at[2], nz, [&](int k, int nearer_k) {
    // The light's own layer comes first, and again before those on its other side.
    if (nearer_k >= 0 && nearer_k != last) {
      for (int j = 0; j < ny; ++j) {
        const float* from = depths + static_cast<std::size_t>(nx) * static_cast<std::size_t>(nearer_k * ny + j);
        std::copy_n(from, nx, here.data() + stride * static_cast<std::size_t>(j));
      }
    }
    std::swap(here, before);
    outward(at[1], ny, [&](int j, int nearer_j) {
      float* row = here.data() + stride * static_cast<std::size_t>(j);
      CellLine line;
      const std::size_t ring_row =
          static_cast<std::size_t>(j + 1) + static_cast<std::size_t>(ny + 2) * static_cast<std::size_t>(k + 1);
      line.extinction = voxels + 3 + static_cast<std::size_t>(nx + 2) * ring_row + 1;
      line.nearer_y = nearer_j >= 0 ? here.data() + stride * static_cast<std::size_t>(nearer_j) : nullptr;
      line.nearer_z = nearer_k >= 0 ? before.data() + stride * static_cast<std::size_t>(j) : nullptr;
      line.x = from_light(0, 0), line.y = from_light(1, j), line.z = from_light(2, k);
      line.sums = sums.data(), line.shares = shares.data();
      entry(HWY_DISPATCH_TABLE(line_sums), simd)(a, line, cell);
      outward(at[0], nx, [&](int i, int nearer) {
        const auto n = static_cast<std::size_t>(i);
        row[n] = nearer < 0 ? sums[n] : std::fma(shares[n], row[nearer], sums[n]);
      });
      std::copy_n(row, nx, depths + static_cast<std::size_t>(nx) * static_cast<std::size_t>(k * ny + j));
    });
    last = k;
  });
}

}  // namespace

void run_volume(const OpticalDepthPropagation& a, const BufferView& view, Workers& workers, Simd simd) {
  const DepthVolume& v = a.volume;
  std::vector<float> packed;  // what becomes halves
  if (v.halves) packed.resize(DepthVolume::head + v.depths());
  float* out = packed.empty() ? view.made(a.depths) : packed.data();
  for (int axis = 0; axis < 3; ++axis) {
    out[axis] = v.first[axis];
    out[3 + axis] = v.scale[axis];
    out[6 + axis] = v.nodes[axis];
  }
  const float* voxels = view.floats(a.voxels);
  if (v.kind == DepthVolume::Kind::cells) {
    sweep(a, voxels, out + 9, simd);
    return;
  }
  const int nx = static_cast<int>(v.nodes.x), ny = static_cast<int>(v.nodes.y), nz = static_cast<int>(v.nodes.z);
  const std::size_t of_a_ray = static_cast<std::size_t>(nz) * most_lanes;
  const std::size_t of_a_plane = static_cast<std::size_t>(nx + most_lanes) * static_cast<std::size_t>(2 * ny + 1);
  std::vector<std::vector<float>> scratch(static_cast<std::size_t>(workers.threads()));
  for (std::vector<float>& s : scratch) s.resize(std::max(of_a_ray, of_a_plane));
  std::vector<std::size_t> passed(static_cast<std::size_t>(v.faces() * ny));
  workers.each(v.faces() * ny, [&](int n, int worker) {
    passed[static_cast<std::size_t>(n)] = entry(HWY_DISPATCH_TABLE(ray_row), simd)(
        a, voxels, RayRow{n / ny, n % ny}, scratch[static_cast<std::size_t>(worker)].data(), out + 9);
  });
  view.counts.parts = passed.size() * static_cast<std::size_t>(nx) * a.gaussians.size();
  view.counts.skipped_parts = std::accumulate(passed.begin(), passed.end(), std::size_t{0});
  workers.each(v.faces() * nz, [&](int n, int worker) {
    float* plane = out + 9 + static_cast<std::ptrdiff_t>(nx) * ny * n;
    entry(HWY_DISPATCH_TABLE(sharpen_plane), simd)(nx, ny, plane, scratch[static_cast<std::size_t>(worker)].data());
  });
  if (!packed.empty()) pack_halves(packed, DepthVolume::head, v.depths(), 1, view.made(a.depths), workers);
}

}  // namespace airlight
#endif
