// What Gaussians are fitted to: the cells of a grid, where it has something and around it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "common/scene/sparse_grid.h"

namespace airlight {

// A Gaussian in the frame of the cells: extinction * exp(-|A (x - center)|^2 / radius^2), A cells to metres.
struct FitGaussian {
  glm::dvec3 center{0};   // [cells]; the centre of cell (i, j, k) is at (i, j, k)
  double radius = 1;      // [m]
  double extinction = 0;  // the grid's unit
};

using BlockValues = std::array<float, 512>;  // of 8^3 cells, x fastest

// Blocks of the grid, and empty ones on all sides of each, so that what a sum has where the grid has nothing counts as well.
class FitCells {
 public:
  // Throws InputError where the grid's transform has no inverse; `path` stands for the grid.
  FitCells(const SparseGrid&, const std::string& path);

  std::size_t size() const { return first_.size(); }
  const glm::ivec3& first(std::size_t block) const { return first_[block]; }
  const BlockValues& target(std::size_t block) const { return target_[block]; }
  // The index of the block with this first cell / 8, or -1.
  int find(const glm::ivec3& block) const;
  // Blocks that a ball about a place [cells] with this radius [m] may meet, rising.
  void meeting(const glm::dvec3& center, double radius, std::vector<std::uint32_t>& blocks) const;

  const glm::dmat3& axes() const { return axes_; }        // cells to metres, without the origin
  const glm::dmat3& inverse() const { return inverse_; }  // metres to cells
  const glm::dvec3& origin() const { return origin_; }    // [m] where cell (0, 0, 0) stands
  double cell() const { return cell_; }                   // [m] side of a cube of a cell's volume
  double energy() const { return energy_; }               // sum of the squares of the grid's values
  double width() const { return width_; }                 // [m] the longest side of the box of its values

 private:
  struct Hash {
    std::size_t operator()(const glm::ivec3& b) const;
  };
  std::vector<glm::ivec3> first_;
  std::vector<BlockValues> target_;
  std::unordered_map<glm::ivec3, std::uint32_t, Hash> places_;
  glm::dmat3 axes_{1.0}, inverse_{1.0};
  glm::dvec3 origin_{0}, reach_{1};  // reach_: [cells/m] half the box of a ball of radius 1 m
  double cell_ = 1, energy_ = 0, width_ = 1;
};

}  // namespace airlight
