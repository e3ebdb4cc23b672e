#include "common/fit/placement.h"

#include <algorithm>
#include <cmath>

#include "common/fit/block_gaussian.h"

namespace airlight {

namespace {

class Peaks {
 public:
  Peaks(const FitCells& cells, std::vector<BlockValues>& rest) : cells_(cells), rest_(rest), highest_(cells.size()) {
    for (std::size_t b = 0; b < cells.size(); ++b) look(b);
  }

  // False: nothing is left.
  bool place(FitGaussian& placed) {
    std::size_t block = 0;
    for (std::size_t b = 1; b < highest_.size(); ++b) block = highest_[b].value > highest_[block].value ? b : block;
    const Highest& peak = highest_[block];
    if (!(peak.value > 0)) return false;
    const auto at = static_cast<int>(peak.at);
    const glm::dvec3 center = glm::dvec3(cells_.first(block) + glm::ivec3(at % 8, at / 8 % 8, at / 64));

    // From the least radius on, each half as large again, as long as that leaves less.
    double most = 0;
    for (double radius = 0.9 * cells_.cell(); radius < 0.5 * cells_.width() + cells_.cell(); radius *= 1.5) {
      const FitGaussian one{center, radius, 1};
      double product = 0, square = 0;
      cells_.meeting(center, BlockGaussian::reach * radius, blocks_);
      for (const std::uint32_t b : blocks_) {
        Lanes sums = lanes(0), squares = lanes(0);
        BlockGaussian(cells_, b, one).each_row([&](int row, float, float, Lanes q0, Lanes q1) {
          const Lanes e0 = exp_minus(q0), e1 = exp_minus(q1);
          const float* const r = rest_[b].data() + 8 * row;
          sums += load(r) * e0 + load(r + 4) * e1;
          squares += e0 * e0 + e1 * e1;
        });
        for (int k = 0; k < 4; ++k) product += static_cast<double>(sums[k]), square += static_cast<double>(squares[k]);
      }
      const double gain = product > 0 ? product * product / square : 0;
      if (gain <= most) break;
      most = gain;
      placed = {center, radius, product / square};
    }
    if (most == 0) placed = {center, 0.9 * cells_.cell(), static_cast<double>(peak.value)};
    take(placed);
    return true;
  }

 private:
  struct Highest {
    float value;
    std::size_t at;
  };
  void look(std::size_t b) {
    const BlockValues& r = rest_[b];
    const auto at = std::max_element(r.begin(), r.end());
    highest_[b] = {*at, static_cast<std::size_t>(at - r.begin())};
  }
  void take(const FitGaussian& g) {
    cells_.meeting(g.center, BlockGaussian::reach * g.radius, blocks_);
    const Lanes c = lanes(static_cast<float>(g.extinction));
    for (const std::uint32_t b : blocks_) {
      BlockGaussian(cells_, b, g).each_row([&](int row, float, float, Lanes q0, Lanes q1) {
        float* const r = rest_[b].data() + 8 * row;
        store(r, load(r) - c * exp_minus(q0)), store(r + 4, load(r + 4) - c * exp_minus(q1));
      });
      look(b);
    }
  }

  const FitCells& cells_;
  std::vector<BlockValues>& rest_;
  std::vector<Highest> highest_;  // of each block
  std::vector<std::uint32_t> blocks_;
};

}  // namespace

void add_at_peaks(const FitCells& cells, int count, std::vector<BlockValues>& rest, std::vector<FitGaussian>& gaussians) {
  Peaks peaks(cells, rest);
  for (FitGaussian g; count > 0 && peaks.place(g); --count) gaussians.push_back(g);
}

}  // namespace airlight
