// A sum of Gaussians on the cells of a grid, and how what is left changes with each of them.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "common/fit/fit_cells.h"

namespace airlight {

// Calls body(i) for i in 0..n-1, in any order and on any thread; returns when all are done.
using EachIndex = std::function<void(int n, const std::function<void(int i)>& body)>;

// Slopes of half the sum of the squares of what is left.
struct FitSlopes {
  glm::dvec3 center{0};  // [1/m] by a move in metres along x, y, z
  double radius = 0;     // [1/m]
  double extinction = 0;
};

// The results are the same for any EachIndex: sums are made in a fixed order.
class GaussianSum {
 public:
  GaussianSum(const FitCells& cells, EachIndex each) : cells_(cells), each_(std::move(each)), rest_(cells.size()) {}

  // Half the sum of the squares of the grid less the Gaussians, over all cells; slopes, one a Gaussian, where they are wanted.
  double half_squares(std::span<const FitGaussian>, std::vector<FitSlopes>* slopes);

  // The grid less the Gaussians of the last call, a block each.
  std::vector<BlockValues>& rest() { return rest_; }

 private:
  // A Gaussian in a block: sums over its cells of what is left times exp(-q), plain and times x, y, z and q.
  struct Part {
    std::uint32_t gaussian;
    std::array<double, 5> sums;
  };
  void pair_up(std::span<const FitGaussian>);
  double block(std::size_t, std::span<const FitGaussian>, bool slopes);

  const FitCells& cells_;
  EachIndex each_;
  std::vector<BlockValues> rest_;
  std::vector<std::vector<std::uint32_t>> blocks_of_;  // of each Gaussian
  std::vector<std::uint32_t> begins_;                  // of each block in parts_
  std::vector<Part> parts_;                            // by block, then by Gaussian
};

}  // namespace airlight
