#include "common/fit/fit_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tuple>

#include "common/error.h"

namespace airlight {

std::size_t FitCells::Hash::operator()(const glm::ivec3& b) const {
  std::uint64_t h = 0x9E3779B97F4A7C15ULL;
  for (int k = 0; k < 3; ++k) h = (h ^ static_cast<std::uint32_t>(b[k])) * 0xD6E8FEB86659FD93ULL, h ^= h >> 32;
  return static_cast<std::size_t>(h);
}

FitCells::FitCells(const SparseGrid& grid, const std::string& path) {
  axes_ = glm::dmat3(grid.transform);
  origin_ = glm::dvec3(grid.transform[3]);
  const double volume = std::abs(glm::determinant(axes_));
  const double box = glm::length(axes_[0]) * glm::length(axes_[1]) * glm::length(axes_[2]);
  if (!(volume > 1e-9 * box && box > 1e-30)) throw InputError(path + ": its transform is singular, expected an invertible one");
  cell_ = std::cbrt(volume);
  inverse_ = glm::inverse(axes_);
  for (int k = 0; k < 3; ++k) {
    reach_[k] = glm::length(glm::dvec3(inverse_[0][k], inverse_[1][k], inverse_[2][k]));
    width_ = std::max(k == 0 ? 0 : width_, glm::length(axes_[k]) * grid.size(k));
  }

  for (const GridBlock& b : grid.blocks) {
    const glm::ivec3 block = b.first / 8;  // exact
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) first_.push_back(8 * (block + glm::ivec3(x, y, z)));
      }
    }
    for (const float v : b.values) energy_ += static_cast<double>(v) * static_cast<double>(v);
  }
  const auto before = [](const glm::ivec3& a, const glm::ivec3& b) { return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x); };
  std::sort(first_.begin(), first_.end(), before);
  first_.erase(std::unique(first_.begin(), first_.end()), first_.end());
  target_.resize(first_.size());
  for (std::size_t i = 0; i < first_.size(); ++i) places_.emplace(first_[i] / 8, static_cast<std::uint32_t>(i));
  for (const GridBlock& b : grid.blocks) target_[places_.at(b.first / 8)] = b.values;
}

int FitCells::find(const glm::ivec3& block) const {
  const auto found = places_.find(block);
  return found == places_.end() ? -1 : static_cast<int>(found->second);
}

void FitCells::meeting(const glm::dvec3& center, double radius, std::vector<std::uint32_t>& blocks) const {
  glm::ivec3 from, to, b;
  for (int k = 0; k < 3; ++k) {
    // Held within the grid's own range of blocks, which is within that of an int.
    const double half = reach_[k] * radius;
    from[k] = static_cast<int>(std::clamp(std::floor((center[k] - half) / 8), -2e8, 2e8));
    to[k] = static_cast<int>(std::clamp(std::floor((center[k] + half) / 8), -2e8, 2e8));
  }
  blocks.clear();
  if (static_cast<double>(to.x - from.x + 1) * (to.y - from.y + 1) * (to.z - from.z + 1) > static_cast<double>(first_.size())) {
    for (std::size_t i = 0; i < first_.size(); ++i) {
      const glm::ivec3 at = first_[i] / 8;
      if (at.x >= from.x && at.x <= to.x && at.y >= from.y && at.y <= to.y && at.z >= from.z && at.z <= to.z)
        blocks.push_back(static_cast<std::uint32_t>(i));
    }
    return;
  }
  for (b.z = from.z; b.z <= to.z; ++b.z) {
    for (b.y = from.y; b.y <= to.y; ++b.y) {
      for (b.x = from.x; b.x <= to.x; ++b.x) {
        if (const int found = find(b); found >= 0) blocks.push_back(static_cast<std::uint32_t>(found));
      }
    }
  }
}

}  // namespace airlight
