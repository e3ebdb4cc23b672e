#include "cpu/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/mean_depth_lattice.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>

#include "cpu/simd.h"
//
#include "cpu/pixel_rays.h"
//
#include "cpu/gaussian_mean_depth.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

// Of the nodes begin .. end - 1 of a lattice; `depths` has room for the last lanes behind.
static void lattice_depths(const MeanDepthLattice& a, const DepthLattice& lattice, int begin, int end, float* depths) {
  HWY_ALIGN float at[3][16];
  for (int n = begin; n < end; n += lanes) {
    for (int lane = 0; lane < lanes; ++lane) {
      const int node = std::min(n + lane, end - 1), line = node / lattice.nodes.x, layer = line / lattice.nodes.y;
      at[0][lane] = static_cast<float>(node % lattice.nodes.x);
      at[1][lane] = static_cast<float>(line % lattice.nodes.y);
      at[2][lane] = static_cast<float>(layer);
    }
    const glm::vec3& corner = lattice.corner;
    const Real3 place{fma(load(at[0]), lattice.spacing, corner.x), fma(load(at[1]), lattice.spacing, corner.y),
                      fma(load(at[2]), lattice.spacing, corner.z)};
    store(gaussian_mean_depth(a.gaussians, place), depths + (n - begin));
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(lattice_depths);

void run_volume(const MeanDepthLattice& a, const BufferView& view, Workers& workers, Simd simd) {
  constexpr int batch = 256;
  struct Batch {
    const DepthLattice* lattice;
    int begin, end;
  };
  std::vector<Batch> batches;
  for (const DepthLattice& l : a.lattices) {
    const int nodes = l.nodes.x * l.nodes.y * l.nodes.z;
    for (int n = 0; n < nodes; n += batch) batches.push_back({&l, n, std::min(n + batch, nodes)});
  }
  float* out = view.made(a.depths);
  workers.each(static_cast<int>(batches.size()), [&](int i, int) {
    const Batch& b = batches[static_cast<std::size_t>(i)];
    float depths[batch + 16];
    entry(HWY_DISPATCH_TABLE(lattice_depths), simd)(a, *b.lattice, b.begin, b.end, depths);
    std::copy(depths, depths + (b.end - b.begin), out + b.lattice->first + b.begin);
  });
  const auto floats = static_cast<std::ptrdiff_t>(a.depths.bytes / sizeof(float));
  std::fill(out + floats - depth_lattice_padding, out + floats, 0.0F);
}

}  // namespace airlight
#endif
