#include "common/plan/voxels.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "common/plan/hash.h"
#include "common/plan/upload.h"

namespace airlight {

namespace {

struct Size {
  std::size_t x, y, z;
  std::size_t count() const { return x * y * z; }
  std::size_t at(std::size_t i, std::size_t j, std::size_t k) const { return i + x * (j + y * k); }
};

Size in_ring(const glm::ivec3& cells) {
  return {static_cast<std::size_t>(cells.x) + 2, static_cast<std::size_t>(cells.y) + 2, static_cast<std::size_t>(cells.z) + 2};
}

Size bricks_of(const glm::ivec3& cells) {
  const auto an_axis = [](int n) { return static_cast<std::size_t>(bricks_an_axis(n)); };
  return {an_axis(cells.x), an_axis(cells.y), an_axis(cells.z)};
}

void add_size(std::vector<float>& table, std::size_t x, std::size_t y, std::size_t z) {
  for (const std::size_t n : {x, y, z}) table.push_back(static_cast<float>(n));
}

}  // namespace

std::vector<float> voxel_table(const GridMedium& grid) {
  const Size ring = in_ring(grid.voxels->size), bricks = bricks_of(grid.voxels->size);
  constexpr std::size_t side = brick_side;
  std::vector<float> table;
  table.reserve(voxel_table_floats(grid.voxels->size));
  add_size(table, ring.x - 2, ring.y - 2, ring.z - 2);
  std::vector<float> bounds(bricks.count(), 0.0F);
  auto next = grid.voxels->values.begin();
  for (std::size_t k = 0; k < ring.z; ++k) {
    for (std::size_t j = 0; j < ring.y; ++j) {
      for (std::size_t i = 0; i < ring.x; ++i) {
        const bool inside = i > 0 && j > 0 && k > 0 && i < ring.x - 1 && j < ring.y - 1 && k < ring.z - 1;
        const float value = inside ? static_cast<float>(static_cast<double>(*next++) * grid.scale) : 0.0F;
        table.push_back(value);
        if (!(value > 0)) continue;
        // A lookup that begins one cell before meets it too.
        for (std::size_t c = (k - 1) / side; c <= k / side; ++c) {
          for (std::size_t b = (j - 1) / side; b <= j / side; ++b) {
            for (std::size_t a = (i - 1) / side; a <= i / side; ++a) {
              if (a >= bricks.x || b >= bricks.y || c >= bricks.z) continue;
              float& bound = bounds[bricks.at(a, b, c)];
              bound = std::max(bound, value);
            }
          }
        }
      }
    }
  }
  add_size(table, bricks.x, bricks.y, bricks.z);
  table.insert(table.end(), bounds.begin(), bounds.end());
  return table;
}

GridDensity grid_density(const GridMedium& grid, const glm::dvec3& camera) {
  const glm::dmat4 to_cells = glm::inverse(grid.transform);
  GridDensity density;
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3 row(to_cells[0][axis], to_cells[1][axis], to_cells[2][axis]);
    // From the corner of the box to the first centre is half a cell.
    density.cells[axis] = glm::dvec4(row, glm::dot(row, camera) + to_cells[3][axis] - 0.5);
  }
  density.size = grid.voxels->size;
  density.albedo = grid.albedo;
  return density;
}

Plan::Upload voxels_of(const GridMedium& grid, std::uint32_t id) {
  Hash key;
  key.add(glm::vec3(grid.voxels->size));
  key.bytes(std::as_bytes(std::span(grid.voxels->values)));
  key.add(grid.scale);
  const Buffer buffer{{id}, sizeof(float) * voxel_table_floats(grid.voxels->size)};
  return table_upload(buffer, key.value(), [grid] { return voxel_table(grid); });
}

}  // namespace airlight
