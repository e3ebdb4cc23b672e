#include "common/fit/gaussian_sum.h"

#include "common/fit/block_gaussian.h"

namespace airlight {

namespace {

constexpr int group = 64;  // Gaussians to a piece of work

double sum_of(Lanes v) {
  return (static_cast<double>(v[0]) + static_cast<double>(v[1])) + (static_cast<double>(v[2]) + static_cast<double>(v[3]));
}

}  // namespace

void GaussianSum::pair_up(std::span<const FitGaussian> gaussians) {
  const std::size_t n = gaussians.size();
  blocks_of_.resize(n);
  each_(static_cast<int>((n + group - 1) / group), [&](int i) {
    for (std::size_t g = static_cast<std::size_t>(i) * group; g < std::min(n, static_cast<std::size_t>(i + 1) * group); ++g)
      cells_.meeting(gaussians[g].center, BlockGaussian::reach * gaussians[g].radius, blocks_of_[g]);
  });
  begins_.assign(cells_.size() + 1, 0);
  for (const auto& blocks : blocks_of_) {
    for (const std::uint32_t b : blocks) ++begins_[b + 1];
  }
  for (std::size_t b = 0; b < cells_.size(); ++b) begins_[b + 1] += begins_[b];
  parts_.resize(begins_.back());
  std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
  for (std::size_t g = 0; g < n; ++g) {
    for (const std::uint32_t b : blocks_of_[g]) parts_[next[b]++].gaussian = static_cast<std::uint32_t>(g);
  }
}

double GaussianSum::block(std::size_t index, std::span<const FitGaussian> gaussians, bool slopes) {
  thread_local std::vector<float> kept;  // exp(-q) and q of each Gaussian here, for the second pass
  const std::size_t begin = begins_[index], count = begins_[index + 1] - begin;
  BlockValues& rest = rest_[index];
  rest = cells_.target(index);
  if (slopes && kept.size() < 1024 * count) kept.resize(1024 * count);

  for (std::size_t p = 0; p < count; ++p) {
    const FitGaussian& g = gaussians[parts_[begin + p].gaussian];
    const Lanes c = lanes(static_cast<float>(g.extinction));
    float* const at = slopes ? kept.data() + 1024 * p : nullptr;
    BlockGaussian(cells_, index, g).each_row([&](int row, float, float, Lanes q0, Lanes q1) {
      const Lanes e0 = exp_minus(q0), e1 = exp_minus(q1);
      float* const r = rest.data() + 8 * row;
      store(r, load(r) - c * e0), store(r + 4, load(r + 4) - c * e1);
      if (slopes) store(at + 8 * row, e0), store(at + 8 * row + 4, e1);
    });
  }
  double squares = 0;
  for (std::size_t i = 0; i < 512; i += 4) squares += sum_of(load(&rest[i]) * load(&rest[i]));
  if (!slopes) return 0.5 * squares;

  for (std::size_t p = 0; p < count; ++p) {
    Part& part = parts_[begin + p];
    const BlockGaussian on(cells_, index, gaussians[part.gaussian]);
    const float* const at = kept.data() + 1024 * p;
    const Lanes x0 = on.dx(0), x1 = on.dx(4);
    Lanes s = lanes(0), sx = s, sy = s, sz = s, sq = s;
    on.each_row([&](int row, float y, float z, Lanes q0, Lanes q1) {
      const float* const r = rest.data() + 8 * row;
      const Lanes w0 = load(r) * load(at + 8 * row), w1 = load(r + 4) * load(at + 8 * row + 4), w = w0 + w1;
      s += w;
      sx += w0 * x0 + w1 * x1;
      sy += w * y;
      sz += w * z;
      sq += w0 * q0 + w1 * q1;
    });
    part.sums = {sum_of(s), sum_of(sx), sum_of(sy), sum_of(sz), sum_of(sq)};
  }
  return 0.5 * squares;
}

double GaussianSum::half_squares(std::span<const FitGaussian> gaussians, std::vector<FitSlopes>* slopes) {
  pair_up(gaussians);
  std::vector<double> squares(cells_.size());
  each_(static_cast<int>(cells_.size()),
        [&](int b) { squares[static_cast<std::size_t>(b)] = block(static_cast<std::size_t>(b), gaussians, slopes != nullptr); });
  double all = 0;
  for (const double s : squares) all += s;
  if (!slopes) return all;

  std::vector<std::array<double, 5>> sums(gaussians.size(), std::array<double, 5>{});
  for (const Part& part : parts_) {
    for (std::size_t k = 0; k < 5; ++k) sums[part.gaussian][k] += part.sums[k];
  }
  slopes->resize(gaussians.size());
  for (std::size_t g = 0; g < gaussians.size(); ++g) {
    const auto& [s, x, y, z, q] = sums[g];
    const double c = gaussians[g].extinction, r = gaussians[g].radius;
    (*slopes)[g] = {-2 * c / (r * r) * (cells_.axes() * glm::dvec3(x, y, z)), -2 * c / r * q, -s};
  }
  return all;
}

}  // namespace airlight
