// Gaussians and a grid for the parity cases.
#pragma once

#include <cstddef>
#include <vector>

#include "common/algorithms/medium.h"
#include "common/scene/scene.h"
#include "tests/parity/case.h"

namespace airlight {

// What uneven medium a case has.
struct TestMedium {
  std::vector<GaussianDensity> gaussians;
  GridDensity grid;
  Buffer voxels;
};

// `count` Gaussians around the sphere of sphere_on_plane(), of several albedos, one of which glows.
std::vector<GaussianDensity> test_gaussians(int count);
Scene test_gaussian_scene(int count);

// One coarse lattice about the plane and a finer one about the sphere, or one node a surface; and the numbers of its depths.
std::vector<DepthLattice> test_lattices(bool one_node);
std::size_t lattice_floats(const std::vector<DepthLattice>&);

// A turned box of 12 x 9 x 14 cells beside it, a third of which are empty.
GridMedium test_grid();
// The grid's table becomes buffer `id` of the case.
Buffer add_voxels(Case&, const GridMedium&, std::uint32_t id);
void add_test_grid(TestMedium&, Case&, std::uint32_t id);

}  // namespace airlight
