#include "tests/parity/medium.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>

#include "common/plan/geometry.h"
#include "common/plan/voxels.h"
#include "tests/parity/inputs.h"

namespace airlight {

Scene test_gaussian_scene(int count) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::uint32_t>(i);
    const auto number = [&](std::uint32_t which, double from, double to) {
      return from + (to - from) * uniform(170, 8 * k + which);
    };
    Gaussian g;
    g.center = {number(0, -2.5, 2.5), number(1, -1.2, 1.5), number(2, -8, -3)};
    g.radius = number(3, 0.15, 1.1);
    g.extinction = number(4, 0.2, 2.5);
    g.albedo = {0.9, number(5, 0.4, 1), number(6, 0.4, 1)};
    if (i == 1) g.emission = {0.2, 0.1, 0};
    scene.medium.gaussians.push_back(g);
  }
  return scene;
}

std::vector<GaussianDensity> test_gaussians(int count) { return gaussians_of(test_gaussian_scene(count)); }

std::vector<DepthLattice> test_lattices(bool one) {
  std::vector<DepthLattice> both{{{-6, -1.5F, -12}, 0.7F, {18, 2, 16}, 0}, {{-1, -1.2F, -5}, 0.25F, {9, 10, 7}, 0}};
  for (DepthLattice& l : both) l.nodes = one ? glm::ivec3(1) : l.nodes;
  both[1].first = both[0].nodes.x * both[0].nodes.y * both[0].nodes.z;
  return both;
}

std::size_t lattice_floats(const std::vector<DepthLattice>& all) {
  const glm::ivec3& last = all.back().nodes;
  return static_cast<std::size_t>(all.back().first + last.x * last.y * last.z + depth_lattice_padding);
}

GridMedium test_grid() {
  auto voxels = std::make_shared<VoxelGrid>();
  voxels->size = {12, 9, 14};
  const int cells = voxels->size.x * voxels->size.y * voxels->size.z;
  for (int i = 0; i < cells; ++i) {
    const bool empty = i % voxels->size.x < 4;
    voxels->values.push_back(empty ? 0.0F : static_cast<float>(uniform(171, static_cast<std::uint32_t>(i))));
  }
  GridMedium grid{.voxels = voxels, .scale = 1.5, .albedo = {0.7, 0.8, 0.9}};
  grid.transform = glm::translate(glm::dmat4(1), {-0.6, -1.2, -6.5}) * glm::rotate(glm::dmat4(1), 0.5, {0.3, 1, 0.2}) *
                   glm::scale(glm::dmat4(1), {0.2, 0.25, 0.15});
  return grid;
}

Buffer add_voxels(Case& c, const GridMedium& grid, std::uint32_t id) {
  const std::vector<float> table = voxel_table(grid);
  const auto bytes = std::as_bytes(std::span(table));
  const Buffer voxels{{id}, bytes.size()};
  c.buffers.emplace_back(voxels, std::vector<std::byte>(bytes.begin(), bytes.end()));
  return voxels;
}

void add_test_grid(TestMedium& medium, Case& c, std::uint32_t id) {
  const GridMedium grid = test_grid();
  medium.grid = grid_density(grid, {0, 0, 0});
  medium.voxels = add_voxels(c, grid, id);
}

}  // namespace airlight
